# Warnings are errors (-Wrestrict, -Wstringop-overflow and -Warray-bounds misfire on std::string in g++ 12; -Wpsabi warns of
# vector arguments, which only inlined functions have); floating-point contraction is off so that results do not depend on the inliner.
# Nobody reads errno after a square root, which is one instruction without it.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds -Wno-stringop-overread -Wno-psabi -ffp-contract=off -fno-math-errno)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(--param=ggc-min-expand=400 --param=ggc-min-heapsize=1500000)  # collects its garbage less often: 8 % faster
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    # Else states of some hundred bytes are copied by `rep movs`, whose start takes longer than the copy.
    add_compile_options(-mmemcpy-strategy=vector_loop:1024:noalign,libcall:-1:noalign -mmemset-strategy=vector_loop:1024:noalign,libcall:-1:noalign)
  endif()
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(AMBRIG_SANITIZE "" CACHE STRING "comma separated sanitizers, e.g. address,undefined")
if(AMBRIG_SANITIZE)
  # -O1 -g1: compiled in half the time and memory of -O2 -g; lines stay in the reports.
  add_compile_options(-fsanitize=${AMBRIG_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  add_link_options(-fsanitize=${AMBRIG_SANITIZE})
  add_compile_definitions(AMBRIG_SANITIZED)
endif()
