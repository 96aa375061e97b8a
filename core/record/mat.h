#pragma once
/// Records as MATLAB files, through libmatio (which the files mat*.cc of this folder alone know).
///
/// One variable per channel, a vector of any number type; scalars `rate` [Hz] and `start` [s], or a
/// vector t or time. As a MATLAB name has no dots: A_x (one capital, underscore) is "A.x", and the
/// fields of a struct A are "A.x", "A.y"; columns of a matrix m are "m(1)", "m(2)".
/// Structs of dSPACE ControlDesk and of Simulink ("structure with time") bring names and time:
/// mat_structs.h. An optional struct `units` holds texts: units.A_x = 'um'.
#include <string>

#include "core/record/measurement.h"

namespace ambrig {

/// v5 (also compressed) and v7.3, also by programs that write no MATLAB classes (h5py; then vectors
/// over time only). Other variables are left out with a note. Complex
/// vectors are frequency responses on the axis `f`, `freq` or `frequency` [Hz], a real vector
/// `coherence` or NAME_coherence as long as they are is their coherence; the file then holds no
/// record over time.
/// @throws InputError, one line that names the file.
Measurement ReadMatMeasurement(const std::string& path);
/// The record over time of the file. @throws InputError
Record ReadMat(const std::string& path);

/// Version 5, uncompressed. Attributes are not written. @throws InputError
void WriteMat(const Record& record, const std::string& path);

}  // namespace ambrig
