#pragma once
/// Frequency responses of a rig by its exact linearisation.
///
/// Levitated: the closed loop of analysis/closed_loop.h. Held: the coils of the rig under their
/// current loops at the positions and currents of the scenario,
///
///   x = [linkages, states of the iron | integrals | feedback],  one switching period per step
///   (analysis/linear/period_map.h)
///
/// What a record's columns mean stays: currents are the feedback of the amplifiers (mean over the
/// switching period before the row), set-points those in force from the row on.
/// Hysteresis and a soft bus are not in the linear model: multisine_response.h.
#include <complex>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "actuators/magnetics/lane.h"
#include "discovery/case/case.h"

namespace ambrig {

class ClosedLoop;
class OperatingPoint;
class SampledSystem;
class TransferFunction;

/// What a scenario commands from its start on and for good: its steps at t <= 0, without an end.
std::vector<Excitation> StandingExcitations(const Scenario& scenario);

class LinearResponses {
 public:
  /// `rig`: the hypothesis, `drawing`: the nominal rig, which the controller knows. @throws
  /// InputError
  LinearResponses(const RigParameters& rig, const RigParameters& drawing, const Scenario& scenario);
  ~LinearResponses();

  bool stable() const { return stable_; }
  /// In which the slowest mode of a levitated rotor's loop falls to 1/e [s]; 0: held, or none
  /// falls.
  double SlowestDecay() const;
  /// At f [Hz], for every response in order.
  std::vector<std::complex<double>> At(double f, const std::vector<RigResponse>& responses) const;
  /// The operating point itself.
  const OperatingPoint& point() const { return *point_; }

 private:
  using Columns = std::map<std::string, Eigen::VectorXcd>;  // all outputs, by port
  Columns ColumnsAt(double f, const std::vector<RigResponse>& responses) const;
  // Response of a point to a port whose column is given, at omega [rad/s].
  std::complex<double> Between(const ResponsePoint& port, const ResponsePoint& out, double omega,
                               const Eigen::VectorXcd& column) const;
  std::complex<double> Levitated(const ResponsePoint& port, const ResponsePoint& out, double omega,
                                 const Eigen::VectorXcd& column) const;
  std::complex<double> Held(const ResponsePoint& port, const ResponsePoint& out,
                            const Eigen::VectorXcd& column) const;
  /// Of a held rotor: the coil's place among those that carry current. @throws InputError
  Eigen::Index CoilColumn(const ResponsePoint& point) const;
  void Hold(const RigParameters& drawing, const Scenario& scenario);
  void CloseCurrentLoops(const std::vector<std::array<bool, kLanes>>& by_duty);
  void Levitate(double speed);

  std::unique_ptr<OperatingPoint> point_;
  std::unique_ptr<ClosedLoop> loop_;
  std::unique_ptr<TransferFunction> transfer_;
  Eigen::Index feedback_row_ = 0;  // first of the coils' feedback among the loop's outputs
  bool stable_ = true;

  // held rotor
  std::unique_ptr<SampledSystem> held_;             // set-points, duties -> feedback
  std::vector<std::pair<std::size_t, int>> coils_;  // (bearing, lane) of each current
  double period_ = 0;                               // [s]
};

}  // namespace ambrig
