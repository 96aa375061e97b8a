#pragma once
/// A library that a damaged file may crash is tried in a copy of the process before it is called in
/// the process itself.
#include <functional>

namespace ambrig {

/// Calls `work` in a forked copy of this process. False where that copy was ended by a signal, by a
/// sanitizer, or after 60 s of computing: the same call would end this process too. An exception of
/// `work` is no such end. Locks that `work` needs are taken before.
bool SurvivesInACopy(const std::function<void()>& work);

}  // namespace ambrig
