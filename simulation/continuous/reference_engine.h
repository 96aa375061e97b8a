#pragma once
/// The reference engine: the switching rig with every event located, integrated by SUNDIALS to a
/// tight tolerance. It is the independent reference for the switching engine: its own magnetics
/// (actuators/magnetics/coil_network), its own integrator, the same laws for rotor,
/// loops and bridges.
///
/// Located exactly: period starts, ADC samples, both edges of every coil's voltage, starts and ends
/// of loads, faults. Found as roots: currents that reach zero (diodes block), blocked coils that
/// carry again, contacts. Between events everything is smooth.
///
/// Not here: iron laws, copper heating and a bus with impedance (InputError).
/// Source: docs/theory/base_model.md.
#include "simulation/continuous/continuous_rig.h"

namespace ambrig {

struct ReferenceOptions : RunControl {
  SampledOptions sampled = {.noise = false};
  IntegratorOptions integrator;
};

/// @throws InputError for what it cannot do, Interrupted when stopped.
RunResult RunReference(const RigParameters& rig, const Scenario& scenario,
                       const ReferenceOptions& options = {});

/// The same, with the energy balance at the end of every period from the first on.
RunResult RunReference(const RigParameters& rig, const Scenario& scenario,
                       const ReferenceOptions& options, std::vector<EnergyBalance>* energies);

}  // namespace ambrig
