/* What ambrig and the process of a controller tell each other over a stream socket, in lock step.
 *
 * Every message is a header and `bytes` of payload; numbers are those of the machine (doubles of IEEE 754,
 * little-endian on every machine that ambrig runs on). ambrig asks, the other side answers each message with
 * one: WIRE_FORCE after a step, WIRE_DONE after anything else, WIRE_FAILED with a text at any time.
 *
 *   WIRE_SETUP   uint32 magic, version, axes, coils, parameters, text bytes;
 *                double period, f_max[axes], current_limit[coils], parameter[parameters];
 *                names of axes, coils, parameters, each closed by a zero byte
 *   WIRE_HOLD    double time, speed, per axis position, reference, excitation, force; per coil current,
 *   WIRE_STEP    set_point, duty: the same for all three. `force` is what is held (HOLD), what somebody else
 *   WIRE_TRACK   commanded (TRACK), zero (STEP)
 *   WIRE_FORCE   double force[axes], command[coils]
 *
 * The connection's end is the end of the controller.
 */
#ifndef AMBRIG_WIRE_H
#define AMBRIG_WIRE_H

#include <stdint.h>

#define WIRE_MAGIC 0x47424d41u /* "AMBG" */
#define WIRE_VERSION 1u
#define WIRE_MOST_BYTES 1048576u

enum { WIRE_SETUP = 1, WIRE_HOLD, WIRE_STEP, WIRE_TRACK, WIRE_FORCE, WIRE_DONE, WIRE_FAILED };

typedef struct wire_header {
  uint32_t kind;
  uint32_t bytes;
} wire_header;

typedef struct wire_setup {
  uint32_t magic, version, axes, coils, parameters, text_bytes;
} wire_setup;

#endif
