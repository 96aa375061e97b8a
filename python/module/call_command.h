#pragma once
/// The commands of `ambrig` inside this process.
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

namespace ambrig::python {

/// `ambrig ARGUMENTS...`: its exit code and what it printed. One at a time; what Python prints
/// meanwhile is not touched. @throws what the command throws; a wrong option is an InputError.
pybind11::tuple CallCommand(const std::vector<std::string>& arguments,
                            const pybind11::object& progress);

}  // namespace ambrig::python
