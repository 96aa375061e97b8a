#pragma once
/// What every command is to the program: a function that adds its options to the command line and
/// sets the work.
#include <atomic>
#include <functional>

namespace CLI {
class App;
}

namespace ambrig {

/// Set by Ctrl-C; every long work looks at it.
inline std::atomic<bool> interrupted{false};

inline constexpr int kInterruptedCode = 130;
/// The line of a work that was ended, on stderr and for who listens to events.
void TellInterrupted();

/// A command's work; returns the exit code.
using Work = std::function<int()>;

/// All commands, see catalogue.cc.
void AddCommands(CLI::App& app, Work& work);

}  // namespace ambrig
