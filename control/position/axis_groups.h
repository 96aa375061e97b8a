#pragma once
/// Several controllers side by side, each on its own axes: a central one for the radial axes, a PID
/// for the thrust bearing.
#include "control/position/position_controller.h"

namespace ambrig {

struct AxisGroup {
  std::vector<std::size_t> axes;  // of the rig
  std::unique_ptr<PositionController> controller;
};

class AxisGroups : public PositionController {
 public:
  explicit AxisGroups(std::vector<AxisGroup> groups);
  void Observe(const std::vector<BearingControl>& control, double t) override {
    for (Part& p : parts_) p.group.controller->Observe(control, t);
  }
  const Lane* SetPoints(std::size_t bearing) const override;
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
             const std::vector<double>& f) override;
  StateSpace Linear(double Omega) const override;
  std::unique_ptr<PositionController> Clone() const override;

 private:
  struct Part {
    AxisGroup group;
    std::vector<double> y, r, excitation, f;
  };
  static void Gather(const std::vector<std::size_t>& axes, const std::vector<double>& from,
                     std::vector<double>& to);
  std::vector<Part> parts_;
};

}  // namespace ambrig
