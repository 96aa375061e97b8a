#include "core/base/build_id.h"

#include <elf.h>
#include <link.h>

#include <cstring>

namespace ambrig {
namespace {

std::string HexOf(const unsigned char* bytes, std::size_t count) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    text += kDigits[bytes[k] >> 4];
    text += kDigits[bytes[k] & 15];
  }
  return text;
}

/// The GNU build identifier among the notes of one segment; empty when it is not there.
std::string BuildNote(const unsigned char* at, std::size_t bytes) {
  const auto padded = [](std::size_t n) { return (n + 3) / 4 * 4; };
  while (bytes >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, at, sizeof head);
    const std::size_t name = padded(head.n_namesz), text = padded(head.n_descsz);
    if (sizeof head + name + text > bytes) return "";
    if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 &&
        std::memcmp(at + sizeof head, "GNU", 4) == 0)
      return HexOf(at + sizeof head + name, head.n_descsz);
    at += sizeof head + name + text;
    bytes -= sizeof head + name + text;
  }
  return "";
}

}  // namespace

std::string BuildId() {
  std::string id;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* out) {
        for (int k = 0; k < info->dlpi_phnum; ++k) {
          const auto& segment = info->dlpi_phdr[k];
          if (segment.p_type != PT_NOTE) continue;
          const auto* begin =
              reinterpret_cast<const unsigned char*>(info->dlpi_addr + segment.p_vaddr);
          std::string found = BuildNote(begin, segment.p_memsz);
          if (!found.empty()) *static_cast<std::string*>(out) = std::move(found);
        }
        return 1;  // the first object is the program itself
      },
      &id);
  return id;
}

}  // namespace ambrig
