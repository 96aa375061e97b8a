#pragma once
/// Records as HDF5 files: one 1-D dataset per channel with string attribute `unit`; root attributes
/// `rate` [Hz], `start` [s] and any further texts. Only hdf5_reader.cc and
/// hdf5_writer.cc know the HDF5 library.
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "core/record/record.h"

namespace ambrig {

/// Datasets of any number type; those in groups are named with dots ("A/x" is "A.x"); a dataset t
/// or time serves as the time base, single numbers `rate` and `start` for the attributes. NaN is
/// kept. What is not a vector of numbers is left out with a note.
/// @throws InputError, one line that names the file: not HDF5, damaged, no rate, unequal lengths
/// ...
Record ReadHdf5(const std::string& path);

/// Double precision, each channel compressed where that pays (hdf5_deflate_gain.h); same record,
/// same bytes. The file appears complete or not at all.
/// @throws InputError
void WriteHdf5(const Record& record, const std::string& path);

/// Several records in one file, each a group with channels, `rate` and `start` of
/// its own; `attributes` are the file's. Names of groups have neither slash nor
/// dot. @throws InputError
void WriteHdf5Groups(const std::vector<std::pair<std::string, Record>>& records,
                     const std::map<std::string, std::string>& attributes, const std::string& path);

/// The record of one such group. @throws InputError, also when there is no such group
Record ReadHdf5Group(const std::string& path, const std::string& group);

/// Whether a dataset or group in the file's root carries this attribute. @throws InputError
bool HasObjectWith(const std::string& attribute, const std::string& path);

/// Tries `read` of the file in a copy of the process first: HDF5 1.10 believes what an attribute
/// says of its own size and place, and a damaged one crashes it. Under Hdf5Mutex. @throws
/// InputError when the copy crashes or does not end
void RefuseWhatCrashesHdf5(const std::string& path, const std::function<void()>& read);

/// Held during every use of the HDF5 library, which may be built without thread safety; the MAT
/// reader needs it too (v7.3 files are HDF5).
std::mutex& Hdf5Mutex();

}  // namespace ambrig
