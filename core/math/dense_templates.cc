#include "core/math/dense_templates.h"

#define AMBRIG_DENSE template
#include "core/math/dense_templates.inc"
