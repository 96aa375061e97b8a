#include "python/module/background.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace ambrig::python {

namespace py = pybind11;

namespace {

constexpr auto kLook = std::chrono::milliseconds(80);

/// Signals and progress, with the lock. @return what Python raised, if it did.
std::optional<py::error_already_set> Look(const py::object& progress, double fraction,
                                          double* told) {
  const py::gil_scoped_acquire lock;
  try {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none() && fraction != *told) progress(*told = fraction);
  } catch (const py::error_already_set& e) {
    return e;
  }
  return std::nullopt;
}

}  // namespace

void InBackground(const std::function<void()>& work, Watch& watch, const py::object& progress) {
  std::exception_ptr error;
  std::optional<py::error_already_set> raised;
  double told = -1;
  {
    const py::gil_scoped_release released;
    std::mutex mutex;
    std::condition_variable ended;
    bool done = false;
    std::thread thread([&] {
      try {
        work();
      } catch (...) {
        error = std::current_exception();
      }
      const std::lock_guard guard(mutex);
      done = true;
      ended.notify_one();
    });
    std::unique_lock guard(mutex);
    while (!ended.wait_for(guard, kLook, [&] { return done; })) {
      if (raised) continue;
      guard.unlock();
      raised = Look(progress, watch.fraction.load(), &told);
      if (raised) watch.stop->store(true);
      guard.lock();
    }
    guard.unlock();
    thread.join();
  }
  if (raised) throw py::error_already_set(*raised);
  if (error) std::rethrow_exception(error);
  if (!progress.is_none() && told != 1) progress(1.0);
}

}  // namespace ambrig::python
