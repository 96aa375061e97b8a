#pragma once
/// Coils of any stator that were lost, from the balance of their linkages over
/// whole switching periods:
///
///   e_j = (λ_j(i, r) at the start of this period - of the last) / T + R mean(i_j) - mean(v_j)
///
/// λ(i, r) = (Nᵀ A(r) N + L_l) i + λ_magnets is the nominal network's (pole_network.h), i
/// the ADC samples, v what the duty asks of a healthy bridge. Whatever the neighbours do is in
/// their currents, so e_j tells of coil j alone [V].
///
/// A coil is given up when |e_j| goes beyond the threshold while there is no current in
/// it, three periods in a row (bridges of two quadrants: only where a current is asked of it, for
/// their diodes block). A current that went faster than its inductance lets it fall was broken
/// ("open"), else its amplifier does not drive ("amplifier-off"). Coils that carry current are
/// judged by their slopes: linkage_phases.h. Source: docs/theory/stators.md.
#include "fdd/detectors/run_detector.h"

namespace ambrig {

/// `setup.model` must have a network. Its threshold is the detector's own,
/// whatever [detection] says.
std::unique_ptr<RunDetector> MakeLinkageBalance(const RunDetectorSetup& setup);

}  // namespace ambrig
