#include "control/position/controller_switch.h"

#include <algorithm>
#include <cmath>

#include "core/base/errors.h"

namespace ambrig {

ControllerSwitch::ControllerSwitch(std::vector<std::unique_ptr<PositionController>> controllers,
                                   std::vector<double> f_max, double Ts)
    : controllers_(std::move(controllers)),
      f_max_(std::move(f_max)),
      keep_(std::exp(-Ts / kFade)),
      difference_(f_max_.size(), 0.0) {}

std::size_t ControllerSwitch::Add(std::unique_ptr<PositionController> controller) {
  controllers_.push_back(std::move(controller));
  return controllers_.size() - 1;
}

void ControllerSwitch::SwitchTo(std::size_t index) {
  Require(index < controllers_.size(), "a controller of the rig");
  next_ = index;
}

void ControllerSwitch::ChangeOver(const std::vector<double>& y, const std::vector<double>& r,
                                  const std::vector<double>& excitation, double Omega,
                                  std::vector<double>& f) {
  const std::vector<double> carried = difference_;
  controllers_[now_]->Step(y, r, excitation, Omega, f);
  std::vector<double> old = f;
  for (std::size_t k = 0; k < f.size(); ++k)
    old[k] = std::clamp(f[k] + carried[k] * keep_, -f_max_[k], f_max_[k]);
  PositionController& in = *controllers_[next_];
  if (past_.empty()) {
    in.Hold(old, y, r);
  } else {
    in.Hold(past_.front().f, past_.front().y, past_.front().r);
    for (const Moment& m : past_) in.Track(m.y, m.r, m.Omega, m.f);
  }
  now_ = next_;
  in.Step(y, r, excitation, Omega, f);
  for (std::size_t k = 0; k < f.size(); ++k) {
    difference_[k] = old[k] - f[k];
    f[k] = old[k];
  }
}

void ControllerSwitch::Step(const std::vector<double>& y, const std::vector<double>& r,
                            const std::vector<double>& excitation, double Omega,
                            std::vector<double>& f) {
  if (next_ != now_) {
    ChangeOver(y, r, excitation, Omega, f);
  } else {
    controllers_[now_]->Step(y, r, excitation, Omega, f);
    for (std::size_t k = 0; k < f.size(); ++k) {
      if (difference_[k] == 0) continue;
      difference_[k] *= keep_;
      if (std::abs(difference_[k]) < 1e-9 * f_max_[k]) difference_[k] = 0;
      f[k] = std::clamp(f[k] + difference_[k], -f_max_[k], f_max_[k]);
    }
  }
  past_.push_back({y, r, f, Omega});
  // What was asked for from outside is no part of the controller's own force.
  for (std::size_t k = 0; k < f.size(); ++k) past_.back().f[k] -= excitation[k];
  if (past_.size() > kRemembered) past_.pop_front();
}

void ControllerSwitch::Hold(const std::vector<double>& force, const std::vector<double>& y,
                            const std::vector<double>& r) {
  std::fill(difference_.begin(), difference_.end(), 0.0);
  past_.clear();
  controllers_[now_]->Hold(force, y, r);
}

void ControllerSwitch::Track(const std::vector<double>& y, const std::vector<double>& r,
                             double Omega, const std::vector<double>& f) {
  controllers_[now_]->Track(y, r, Omega, f);
}

std::unique_ptr<PositionController> ControllerSwitch::Clone() const {
  std::vector<std::unique_ptr<PositionController>> copies;
  for (const auto& c : controllers_) copies.push_back(c->Clone());
  auto copy = std::make_unique<ControllerSwitch>(std::move(copies), f_max_, 1.0);
  copy->keep_ = keep_;
  copy->now_ = now_;
  copy->next_ = next_;
  copy->past_ = past_;
  copy->difference_ = difference_;
  return copy;
}

}  // namespace ambrig
