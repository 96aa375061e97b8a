#pragma once
/// How the coils of a bearing share their flux.

namespace ambrig {

/// kFloatingRotor: all poles meet at the rotor, whose magnetic potential follows from zero net flux
/// (radial). kSides: the two windings of a side share one core (thrust: four coils, the first four
/// lanes). kNone: each coil has its own core (opposed magnets). kNetwork: any poles and windings
/// (pole_network.h), on the general path only.
enum class Coupling { kFloatingRotor, kSides, kNone, kNetwork };

}  // namespace ambrig
