// Frames by the core's reference with one fault planted into the shared source; each makes a subject run so.
#pragma once

#include "stability/subject.hpp"

namespace stability {

void plant_wrap(subject& s);       // taps off the picture read its other side
void plant_mirror(subject& s);     // offsets behind the eye are projected like others
void plant_background(subject& s); // background occludes
void plant_blur(subject& s);       // the filter takes background marks for visibilities

} // namespace stability
