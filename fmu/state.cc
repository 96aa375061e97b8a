/// The state of an FMU as bytes (fmi2SerializeFMUstate): a header, then its numbers as the machine
/// has them.
#include <cstring>

#include "fmu/instance.h"

namespace ambrig {

namespace {

constexpr char kStateMark[8] = {'A', 'M', 'B', 'R', 'I', 'G', 'F', '1'};

struct StateHeader {
  char mark[8];
  std::uint64_t phase = 0, values = 0, changes = 0;
  double start_time = 0, time = 0;
  std::int64_t period = 0;
};

template <class T>
void AppendTo(std::string& bytes, const T* from, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(from), count * sizeof(T));
}

}  // namespace

std::string FmuState::Bytes() const {
  StateHeader head;
  std::memcpy(head.mark, kStateMark, sizeof head.mark);
  head.phase = static_cast<std::uint64_t>(phase);
  head.values = values.size();
  head.changes = changes.size();
  head.start_time = start_time;
  head.time = time;
  head.period = period;
  std::string bytes;
  AppendTo(bytes, &head, 1);
  AppendTo(bytes, start_values.data(), start_values.size());
  AppendTo(bytes, values.data(), values.size());
  AppendTo(bytes, changes.data(), changes.size());
  return bytes;
}

FmuState FmuState::FromBytes(const std::string& bytes, std::size_t variables) {
  static_assert(std::is_trivially_copyable_v<Change> && sizeof(Change) == 24);
  StateHeader head;
  const InputError wrong("the bytes are no state of this FMU");
  if (bytes.size() < sizeof head) throw wrong;
  std::memcpy(&head, bytes.data(), sizeof head);
  const std::size_t room = bytes.size() - sizeof head, most = room / sizeof(Change);
  if (std::memcmp(head.mark, kStateMark, sizeof head.mark) != 0 || head.values != variables ||
      head.phase > static_cast<std::uint64_t>(FmuPhase::kTerminated) || head.changes > most ||
      room != 2 * head.values * sizeof(double) + head.changes * sizeof(Change) || head.period < 0)
    throw wrong;
  FmuState s;
  s.phase = static_cast<FmuPhase>(head.phase);
  s.start_time = head.start_time;
  s.time = head.time;
  s.period = head.period;
  const char* at = bytes.data() + sizeof head;
  for (std::vector<double>* v : {&s.start_values, &s.values}) {
    v->resize(head.values);
    std::memcpy(v->data(), at, head.values * sizeof(double));
    at += head.values * sizeof(double);
  }
  s.changes.resize(head.changes);
  if (head.changes > 0) std::memcpy(s.changes.data(), at, head.changes * sizeof(Change));
  long long before = 0;
  for (const Change& c : s.changes) {
    if (c.reference >= variables || c.period < before || c.period > s.period) throw wrong;
    before = c.period;
  }
  return s;
}

}  // namespace ambrig
