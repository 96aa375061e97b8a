#pragma once
/// The averaged engine: every bridge by its mean over the switching period,
///
///   v = d v_on + (1 - d) v_off        (any pattern: its mean), constant over the period
///
/// the same sampled loops on the same clocks, ARKODE with root finding in between (diodes: i >= 0,
/// contact). Its currents are the cycle means of the switching rig's; what it leaves out is the
/// ripple: the force of ripple² and, where a coil is at its lower limit, currents that flow for a
/// part of the period only. The feedback is the mean current of the last period. No ADC, hence no
/// current noise and no detection. A levitated start comes from KINSOL's equilibrium, then runs its
/// closed loop.
///
/// Not here: iron laws, copper heating, a bus with impedance, records faster than the switching
/// (InputError). Source: docs/theory/base_model.md section 3.
#include "analysis/linear/equilibrium.h"
#include "simulation/continuous/reference_engine.h"

namespace ambrig {

using AveragedOptions = ReferenceOptions;

/// Looser than the reference: its model error is the ripple, not the integrator.
AveragedOptions DefaultAveragedOptions();

/// @throws InputError for what it cannot do, Interrupted when stopped.
RunResult RunAveraged(const RigParameters& rig, const Scenario& scenario,
                      const AveragedOptions& options = DefaultAveragedOptions());

}  // namespace ambrig
