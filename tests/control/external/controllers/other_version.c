/* As if compiled with the header of another year. */
#include <stdint.h>

const uint32_t ambrig_controller_version[2] = {99, 16};
