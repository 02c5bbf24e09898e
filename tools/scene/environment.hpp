#pragma once

#include "ao/scene.hpp"

#include <string>

namespace ao::tools {

// Ambient light of an equirectangular picture: its middle is -Z, right of it +X, its first row +Y. Radiance HDR and OpenEXR are
// linear; PNG, JPEG and TGA are sRGB. Decoded in a child process. Throws `error`: no such file, not a picture, light that is not
// finite or negative.
[[nodiscard]] ao::ambient_light load_environment(const std::string& path);

} // namespace ao::tools
