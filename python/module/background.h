#pragma once
/// Long work away from the interpreter: it runs in a thread of its own without the interpreter's
/// lock, while the calling thread answers Ctrl-C and tells the progress.
#include <pybind11/pybind11.h>

#include <atomic>
#include <functional>

namespace ambrig::python {

/// What the work tells and hears while it goes on.
struct Watch {
  std::atomic<bool>* stop = nullptr;  // set when Python wants an end
  std::atomic<double> fraction{0};    // done so far
};

/// Calls `work` and waits for it. `progress`: None or a callable (fraction), called in the calling
/// thread some ten times a second. An exception of `progress`, or Ctrl-C, sets *stop and is raised
/// when the work has ended. @throws what `work` throws. To be called with the interpreter's lock
/// held.
void InBackground(const std::function<void()>& work, Watch& watch,
                  const pybind11::object& progress);

}  // namespace ambrig::python
