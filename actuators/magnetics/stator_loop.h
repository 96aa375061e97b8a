#pragma once
/// The innermost loop of the fast engine: samples of one switching period of one bearing, or of
/// several side by side (ideal iron, no shorted turns, constant bus). Equations: stator_lanes.h.
#include "actuators/magnetics/coupling.h"
#include "actuators/magnetics/gap_reluctance.h"
#include "actuators/magnetics/lane.h"

namespace ambrig {

/// How the voltage of every coil runs over one switching period: v0 until t1, v1 until t2, then v2.
/// Each voltage is gain * bus + drop; `gain` tells which of the three closes the switches.
struct VoltagePattern {
  Lane t1, t2;            // [s] from the start of the period
  Lane gain[3], drop[3];  // [-], [V]
};

/// What the loop reads and writes of one bearing; pointers to eight lanes each.
struct StatorLoop {
  Coupling coupling = Coupling::kFloatingRotor;
  // Constant over the period: signed turns, R h/2 [ohm s], 1/(L_l + R h/2) and n times it (0 where
  // blocked), L_l [H], conductance at the period's start and its change [H].
  const double *n, *half_rh, *inverse_l, *c, *leakage, *g0, *dg;
  const VoltagePattern* pattern;
  double bus;    // [V]
  double floor;  // [A] no current may fall below it
  // State and Σφ² of the samples' ends.
  double *lambda, *i, *phi, *sum;
  Lane* samples;  // i at the start of every sample [A]
};

/// Samples k .. count - 1 of length h; returns the sample in whose solution a current falls below
/// the floor (its targets λ* are left in `target`, Σφ² lacks it), or `count`.
int RunSamples(const StatorLoop& loop, int k, int count, double h, double* target);

/// Whole periods of several bearings (up to 32), with a look at the sign of the currents only at
/// the end: the dependent chain of one bearing's sample (a sum over the poles, then a product) is
/// several times longer than its arithmetic, so bearings run side by side. Returns a bit for each
/// bearing whose current fell below its floor; its state is as before, to be run by RunSamples.
unsigned RunTogether(const StatorLoop* loops, int bearings, int count, double h);

/// The solution of one sample at `fraction` of the period for the targets λ*.
void SolveSample(const StatorLoop& loop, const double* target, double fraction);

/// Everything of a bearing that changes with its gaps.
struct GapLaw {
  Coupling coupling = Coupling::kFloatingRotor;
  const double *gap_offset, *direction_x, *direction_y, *n, *inverse_l;  // eight lanes each
  GapReluctance reluctance;
};
/// Reluctance at both ends [1/H], its mean slope [1/(H m)], conductance of the circuit at the start
/// and its change [H].
void Reluctances(const GapLaw& law, double x0, double y0, double x1, double y1, double* rel0,
                 double* rel1, double* slope, double* g0, double* dg);

/// Σφ² of a period's samples as RunSamples leaves it, φ² at its start, φ at its end, and by how
/// much a pole's φ² pulls [N/Wb²]; eight lanes each.
struct PullOfPeriod {
  const double *sum, *start_sq, *phi, *weight, *direction_x, *direction_y;
};
/// Mean force of the period by the trapezoid rule: half of the first sample and of the last. [N]
void MeanPull(const PullOfPeriod& p, int count, double* fx, double* fy);

}  // namespace ambrig
