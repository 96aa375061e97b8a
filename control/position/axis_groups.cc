#include "control/position/axis_groups.h"

namespace ambrig {

AxisGroups::AxisGroups(std::vector<AxisGroup> groups) {
  for (AxisGroup& g : groups) {
    Part p;
    p.group = std::move(g);
    for (auto* v : {&p.y, &p.r, &p.excitation, &p.f}) v->assign(p.group.axes.size(), 0.0);
    parts_.push_back(std::move(p));
  }
}

void AxisGroups::Gather(const std::vector<std::size_t>& axes, const std::vector<double>& from,
                        std::vector<double>& to) {
  for (std::size_t k = 0; k < axes.size(); ++k) to[k] = from[axes[k]];
}

void AxisGroups::Step(const std::vector<double>& y, const std::vector<double>& r,
                      const std::vector<double>& excitation, double Omega, std::vector<double>& f) {
  for (Part& p : parts_) {
    Gather(p.group.axes, y, p.y);
    Gather(p.group.axes, r, p.r);
    Gather(p.group.axes, excitation, p.excitation);
    p.group.controller->Step(p.y, p.r, p.excitation, Omega, p.f);
    for (std::size_t k = 0; k < p.f.size(); ++k) f[p.group.axes[k]] = p.f[k];
  }
}

const Lane* AxisGroups::SetPoints(std::size_t bearing) const {
  for (const Part& p : parts_)
    if (const Lane* own = p.group.controller->SetPoints(bearing)) return own;
  return nullptr;
}

void AxisGroups::Hold(const std::vector<double>& force, const std::vector<double>& y,
                      const std::vector<double>& r) {
  for (Part& p : parts_) {
    Gather(p.group.axes, force, p.f);
    Gather(p.group.axes, y, p.y);
    Gather(p.group.axes, r, p.r);
    p.group.controller->Hold(p.f, p.y, p.r);
  }
}

void AxisGroups::Track(const std::vector<double>& y, const std::vector<double>& r, double Omega,
                       const std::vector<double>& f) {
  for (Part& p : parts_) {
    Gather(p.group.axes, f, p.f);
    Gather(p.group.axes, y, p.y);
    Gather(p.group.axes, r, p.r);
    p.group.controller->Track(p.y, p.r, Omega, p.f);
  }
}

StateSpace AxisGroups::Linear(double Omega) const {
  std::vector<StateSpace> systems;
  std::vector<std::size_t> order;
  for (const Part& p : parts_) {
    systems.push_back(p.group.controller->Linear(Omega));
    order.insert(order.end(), p.group.axes.begin(), p.group.axes.end());
  }
  StateSpace all = Append(systems);
  const StateSpace grouped = all;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto from = static_cast<Eigen::Index>(k), to = static_cast<Eigen::Index>(order[k]);
    all.B.col(to) = grouped.B.col(from);
    all.C.row(to) = grouped.C.row(from);
    for (std::size_t j = 0; j < order.size(); ++j)
      all.D(static_cast<Eigen::Index>(order[j]), to) =
          grouped.D(static_cast<Eigen::Index>(j), from);
  }
  return all;
}

std::unique_ptr<PositionController> AxisGroups::Clone() const {
  std::vector<AxisGroup> groups;
  for (const Part& p : parts_) groups.push_back({p.group.axes, p.group.controller->Clone()});
  return std::make_unique<AxisGroups>(std::move(groups));
}

}  // namespace ambrig
