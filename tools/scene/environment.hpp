#pragma once

#include "ao/light_picture.hpp"
#include "ao/scene.hpp"

#include <string>

namespace ao::tools {

// Equirectangular pictures of light: the middle is -Z, right of it +X, the first row +Y. Radiance HDR and OpenEXR are linear;
// PNG, JPEG and TGA are sRGB. Decoded in a child process. Both throw `error`: no such file, not a picture, light that is not
// finite or negative.

[[nodiscard]] ao::ambient_light load_environment(const std::string& path);

// Valid by ao::validate; throws where a side is longer than that allows.
[[nodiscard]] ao::light_picture load_light_picture(const std::string& path);

} // namespace ao::tools
