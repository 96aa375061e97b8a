#pragma once
/// What the reader and the writer of HDF5 files (hdf5_reader.cc, hdf5_writer.cc) share: the library
/// locked, its identifiers owned, its failures in one line. Included by nobody else.
#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <string>
#include <utility>

#include "core/base/errors.h"
#include "core/record/hdf5.h"

namespace ambrig::hdf5 {

/// One thread at a time; and the library prints errors unless told not to.
class Library {
 public:
  Library() : lock_(Hdf5Mutex()) { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

 private:
  std::scoped_lock<std::mutex> lock_;
};

/// An HDF5 identifier that is closed at the end of its scope.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool usable() const { return id_ >= 0; }
  operator hid_t() const { return id_; }  // NOLINT: reads as the identifier it is

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// The library's own words for the failure at hand, without a full stop; empty when it has none.
inline std::string Reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* error, void* out) -> herr_t {
        if (n == 0 && error->desc != nullptr) *static_cast<std::string*>(out) = error->desc;
        return 0;
      },
      &text);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

[[noreturn]] inline void Fail(const std::string& path, const std::string& what) {
  const std::string reason = Reason();
  throw InputError(path + ": " + what + (reason.empty() ? "" : " (" + reason + ")"));
}

}  // namespace ambrig::hdf5
