#pragma once
/// Force-by-force inverse: the currents for one wanted force, without a constant bias and without a
/// matrix W. Of all currents within the amplifiers' range that give the force at the rotor's
/// position it takes those of
///
///   least  sum tau_j i_j^2 / (8 c0^2) - mu log det(G G'),   G = dF/di / (k c0),
///
/// copper loss (R of a shorted coil is tau R) against the loss of control: at zero current no force
/// can be changed, so the second term keeps a bias that moves with the force. It is followed from
/// period to period from the currents of before (sequential quadratic programming, box and slew
/// limits by an active set), so the currents move on one branch while the force turns.
///
/// Unlike W it needs no equality for all forces: it holds wherever dF/di of the coils that can
/// still move has rank two, also about a static load where no bias without net force exists.
/// Source: the unbiased inverse of Meeker, Actuators 6(1):1, 2017, here solved numerically for any
/// failure set, position and current range.
#include "faulttolerance/redistribution/network_force.h"

namespace ambrig {

struct ForceInverseOptions {
  double mu = 0.3;     // healthy bearing without force: bias sqrt(2 mu) c0
  double slew = 1.2;   // [A] largest change of a current from one period to the next
  int iterations = 3;  // of a period
  int starts = 32;     // of the search for the first currents
};

class ForceInverse {
 public:
  ForceInverse(const RedistributionProblem& bearing, const ForceInverseOptions& options = {});

  /// Searches the best currents for `force` [N] with the rotor at (x, y) [m], not bound to earlier
  /// ones. False when none gives the force with control left (least_gain() > 0.02).
  bool Start(const Eigen::Vector2d& force, double x = 0, double y = 0);
  /// Currents of the next period [A]: as near to `force` as range and slew allow.
  const CoilVector& Step(const Eigen::Vector2d& force, double x = 0, double y = 0);
  /// Goes on from these currents instead.
  void SetCurrents(const CoilVector& current);

  const CoilVector& current() const { return i_; }
  Eigen::Vector2d force() const {
    return network_.Force(i_);
  }  // of the network, at the last position
  /// Smallest singular value of dF/di of the coils that can move both ways, over that of the
  /// healthy bearing at bias c0. [-]
  double least_gain() const;
  const NetworkForce& network() const { return network_; }

 private:
  void Iterate(const Eigen::Vector2d& force, const CoilVector& low, const CoilVector& high);
  double Merit() const;

  RedistributionProblem p_;
  ForceInverseOptions o_;
  NetworkForce network_;
  double unit_;      // k c0 [N/A]
  CoilVector live_;  // 1: has turns
  CoilVector i_ = CoilVector::Zero();
};

/// What the inverse holds of a failure set.
struct InverseReach {
  bool holds = false;  // the centre, with control
  double radius = 0;   // [N] forces |f - centre| <= radius are followed on one branch
  double loss = 0;     // copper loss at the centre over the healthy bearing's at bias c0
};

/// Follows forces from `centre` [N] out to circles and round them, in steps of a quarter of a
/// newton, until one is missed by more than 2 %, or until `most` [N].
InverseReach ReachOf(const RedistributionProblem& bearing, const Eigen::Vector2d& centre,
                     double most, const ForceInverseOptions& options = {});

}  // namespace ambrig
