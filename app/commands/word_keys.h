#pragma once
/// Keys of input files that are no numbers of the parameter tables: names, choices, lists, files.
/// What the readers check is in the readers; a test holds this list to every key that the examples
/// and the library use.
#include <span>

namespace ambrig {

struct WordKey {
  const char *section, *key, *allowed, *doc;
};

std::span<const WordKey> WordKeys();

}  // namespace ambrig
