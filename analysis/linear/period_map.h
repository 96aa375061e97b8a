#pragma once
/// One switching period of the linear plant, exact: between the edges of the bridges the voltages
/// are constant, a change of duty moves one edge, which acts as an impulse of linkage there,
///
///   x(T) = e^{AT} x(0) + Σ_j e^{A (T - t_j)} e_j ΔU_j dt_j/dd δd_j
///
/// (an `ideal` amplifier: a step of voltage over the whole period), and the feedback is the mean of
/// the ADC's samples at k T/n before and after the edges. Source: docs/theory/base_model.md section
/// 3.
#include <Eigen/Dense>

#include "analysis/linear/linear_plant.h"

namespace ambrig {

struct PeriodMap {
  double T = 0;                       // [s]
  int samples = 0;                    // of the ADC in a period
  Eigen::MatrixXd state;              // (n x n) x(T) of x(0)
  Eigen::MatrixXd duty;               // (n x c) x(T) of duties
  Eigen::MatrixXd push;               // (n x m) x(T) of constant generalised forces on q
  Eigen::MatrixXd feedback_of_state;  // (c x n)
  Eigen::MatrixXd feedback_of_duty;   // (c x c)
  Eigen::MatrixXd feedback_of_push;   // (c x m)
};

PeriodMap MakePeriodMap(const OperatingPoint& point, const LinearPlant& plant);

}  // namespace ambrig
