#pragma once
/// A controller that is not ambrig's: a shared library in a process of its own, or
/// firmware behind a socket, in lock step with the run (control/external/ambrig_controller.h,
/// docs/guide/controller_in_c.md).
#include "control/external/controller_link.h"
#include "control/interface/controller_kind.h"

namespace ambrig {

/// What a rig file says of an external controller.
struct ExternalSettings : ControllerSettings {
  std::string library, address;  // one of both
  std::string name;              // library or address as the rig file writes it
  std::string where;             // file:line: key of it
  double timeout = 5;            // [s]
  bool commands_currents = false;
  std::vector<std::string> parameter_names;
  std::vector<double> parameters;
};

inline constexpr Field<ExternalSettings> kExternalFields[] = {
    {"timeout", &ExternalSettings::timeout, "s", 0.01, 3600,
     "within which the controller must answer, by the wall clock"},
};

class ExternalController : public PositionController {
 public:
  /// Starts or reaches it and hands over the rig. @throws InputError when it cannot.
  ExternalController(const ExternalSettings& settings, const ControllerSite& site);

  void Observe(const std::vector<BearingControl>& control, double t) override;
  void Step(const std::vector<double>& y, const std::vector<double>& r,
            const std::vector<double>& excitation, double Omega, std::vector<double>& f) override;
  const Lane* SetPoints(std::size_t bearing) const override;
  void Hold(const std::vector<double>& force, const std::vector<double>& y,
            const std::vector<double>& r) override;
  void Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
             const std::vector<double>& f) override;
  /// @throws InputError: there is no linear model of it.
  StateSpace Linear(double Omega) const override;
  /// @throws InputError: it is C already.
  void WriteC(CCode& code) const override;
  /// @throws InputError: nobody can copy its state.
  std::unique_ptr<PositionController> Clone() const override;

 private:
  struct Bearing {
    std::size_t index = 0, coils = 0;  // in the rig
    Lane limit, command;               // [A]
  };
  void SetUp();
  /// The numbers of one period (host/wire.h) into numbers_.
  void Gather(const std::vector<double>& y, const std::vector<double>& r,
              const std::vector<double>& excitation, double Omega, const std::vector<double>* f);
  ControllerLink::Answer Ask(std::uint32_t kind, const char* function);
  void TakeAnswer(const ControllerLink::Answer& answer, std::vector<double>& f);
  [[noreturn]] void Fail(const std::string& text) const;

  ExternalSettings settings_;
  ControllerSite site_;
  std::vector<Bearing> bearings_;
  std::vector<double> coil_values_;  // current, set-point, duty of all coils
  std::size_t coils_ = 0;
  double t_ = 0;  // [s]
  std::vector<double> none_, numbers_, answer_;
  ControllerLink link_;
};

/// What both kinds of external controller have: timeout, commands, parameters.
void ReadExternal(const TomlTable& t, const char* key, ExternalSettings& s);

}  // namespace ambrig
