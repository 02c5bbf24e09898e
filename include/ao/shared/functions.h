// Every shared function, in an order in which each is defined before its first use.
#include "ao/shared/encoding.h"
#include "ao/shared/frame.h"
#include "ao/shared/halton.h"
#include "ao/shared/projection.h"
#include "ao/shared/tile.h"
#include "ao/shared/vector.h"
