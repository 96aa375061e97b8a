#pragma once
/// A record from a file of any known kind (core/record/formats/catalogue.cc).
#include <string>

#include "core/record/measurement.h"
#include "core/record/record.h"

namespace ambrig {

/// All that the file holds. By its content, else by its extension. Units as in the file; `format`
/// becomes the name of its kind. @throws InputError
Measurement ReadMeasurement(const std::string& path, std::string* format = nullptr);

/// The record over time of the file. @throws InputError, also for a file of
/// frequency responses only
Record ReadRecord(const std::string& path);

}  // namespace ambrig
