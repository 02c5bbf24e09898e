// Every shared function, each defined before its first use, which GLSL demands.
// clang-format off
#include "ao/shared/vector.h"
#include "ao/shared/frame.h"
#include "ao/shared/halton.h"
#include "ao/shared/encoding.h"
#include "ao/shared/projection.h"
#include "ao/shared/tile.h"
#include "ao/shared/geometry.h"
#include "ao/shared/geometry_vertex.h"
#include "ao/shared/elementary.h"
#include "ao/shared/sectors.h"
#include "ao/shared/packed_visibility.h"
#include "ao/shared/color.h"
#include "ao/shared/blend.h"
#include "ao/shared/shading.h"
#include "ao/shared/history.h"
#include "ao/shared/temporal.h"
// clang-format on
