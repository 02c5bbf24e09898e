#include "environment.hpp"

#include "ao/ambient.hpp"
#include "ao/color.hpp"
#include "apart.hpp"
#include "error.hpp"

#include <stb_image.h>
#include <tinyexr.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>

namespace ao::tools {
namespace {

struct freed {
    void operator()(void* p) const { std::free(p); }
};

// color(index) of a texel.
template <class Color>
ao::light_picture picture_of(const std::string& path, int width, int height, const Color& color)
{
    ao::light_picture picture{ .width = width, .height = height, .texels = {} };
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    picture.texels.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 light = color(i);
        for (int channel = 0; channel < 3; ++channel)
            if (!(light[channel] >= 0.0f && light[channel] <= 1.0e30f))
                throw error(path + ": light that is negative or not finite");
        picture.texels.push_back(light);
    }
    return picture;
}

ao::light_picture of_floats(const std::string& path, int width, int height, const float* rgba)
{
    return picture_of(path, width, height,
                      [&](std::size_t i) { return glm::vec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]); });
}

ao::light_picture decode(const std::string& path)
{
    int width = 0;
    int height = 0;
    int channels = 0;
    if (IsEXR(path.c_str()) == TINYEXR_SUCCESS) {
        float* rgba = nullptr;
        const char* reason = nullptr;
        if (LoadEXR(&rgba, &width, &height, path.c_str(), &reason) != TINYEXR_SUCCESS)
            throw error(path + ": " + one_line(reason != nullptr ? reason : "not an OpenEXR picture"));
        const std::unique_ptr<float, freed> texels(rgba);
        return of_floats(path, width, height, rgba);
    }
    if (stbi_is_hdr(path.c_str()) != 0) {
        const std::unique_ptr<float, freed> texels(stbi_loadf(path.c_str(), &width, &height, &channels, 4));
        if (!texels)
            throw error(path + ": not a picture: " + one_line(stbi_failure_reason()));
        return of_floats(path, width, height, texels.get());
    }
    const std::unique_ptr<stbi_uc, freed> texels(stbi_load(path.c_str(), &width, &height, &channels, 4));
    if (!texels)
        throw error(path + ": not a picture: " + one_line(stbi_failure_reason()));
    return picture_of(path, width, height, [&](std::size_t i) {
        const stbi_uc* rgba = texels.get() + 4 * i;
        return glm::vec3(ao::srgb_table[rgba[0]], ao::srgb_table[rgba[1]], ao::srgb_table[rgba[2]]);
    });
}

// What `work` makes of the picture, in a child process.
std::string apart(const std::string& path, const std::function<std::string(const ao::light_picture&)>& work)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw error(path + ": no such file");
    if (!std::filesystem::is_regular_file(status))
        throw error(path + ": not a regular file");
    return run_apart(path, 60, [&] { return work(decode(path)); });
}

} // namespace

ao::ambient_light load_environment(const std::string& path)
{
    const std::string bytes = apart(path, [](const ao::light_picture& picture) {
        const auto width = static_cast<std::size_t>(picture.width);
        const ao::ambient_light light =
            ao::ambient_of_environment(width, static_cast<std::size_t>(picture.height), [&](std::size_t row, std::size_t column) {
                return glm::dvec3(picture.texels[row * width + column]);
            });
        return std::string(reinterpret_cast<const char*>(light.coefficients.data()), sizeof light.coefficients);
    });
    ao::ambient_light light;
    if (bytes.size() != sizeof light.coefficients)
        throw error(path + ": not a picture");
    std::memcpy(light.coefficients.data(), bytes.data(), bytes.size());
    for (const glm::vec3& c : light.coefficients)
        for (int channel = 0; channel < 3; ++channel)
            if (!std::isfinite(c[channel]))
                throw error(path + ": light beyond the range of float");
    return light;
}

ao::light_picture load_light_picture(const std::string& path)
{
    using header = std::array<int, 2>;
    const std::string bytes = apart(path, [&](const ao::light_picture& picture) {
        if (const auto valid = ao::validate(picture); !valid)
            throw error(path + ": " + std::string(valid.error().reason()));
        const header sides{ picture.width, picture.height };
        std::string all(reinterpret_cast<const char*>(sides.data()), sizeof sides);
        all.append(reinterpret_cast<const char*>(picture.texels.data()), picture.texels.size() * sizeof(glm::vec3));
        return all;
    });
    header sides{};
    if (bytes.size() < sizeof sides)
        throw error(path + ": not a picture");
    std::memcpy(sides.data(), bytes.data(), sizeof sides);
    ao::light_picture picture{ .width = sides[0], .height = sides[1], .texels = {} };
    picture.texels.resize((bytes.size() - sizeof sides) / sizeof(glm::vec3));
    std::memcpy(picture.texels.data(), bytes.data() + sizeof sides, picture.texels.size() * sizeof(glm::vec3));
    if (!ao::validate(picture))
        throw error(path + ": not a picture");
    return picture;
}

} // namespace ao::tools
