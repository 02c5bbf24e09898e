#include "environment.hpp"

#include "ao/ambient.hpp"
#include "apart.hpp"
#include "error.hpp"

#include <stb_image.h>
#include <tinyexr.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

namespace ao::tools {
namespace {

struct freed {
    void operator()(void* p) const { std::free(p); }
};

// RGBA floats of any origin.
struct float_picture {
    std::unique_ptr<float, freed> texels;
    int width = 0;
    int height = 0;
};

ao::ambient_light of_floats(const std::string& path, const float_picture& p)
{
    const std::size_t count = std::size_t{ 4 } * static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
    for (std::size_t i = 0; i < count; ++i)
        if (i % 4 != 3 && !(p.texels.get()[i] >= 0.0f && p.texels.get()[i] <= 1.0e30f))
            throw error(path + ": light that is negative or not finite");
    return ao::ambient_of_environment(
        static_cast<std::size_t>(p.width), static_cast<std::size_t>(p.height), [&](std::size_t row, std::size_t column) {
            const float* texel = p.texels.get() + 4 * (row * static_cast<std::size_t>(p.width) + column);
            return glm::dvec3(texel[0], texel[1], texel[2]);
        });
}

ao::ambient_light decode(const std::string& path)
{
    if (IsEXR(path.c_str()) == TINYEXR_SUCCESS) {
        float_picture p;
        float* texels = nullptr;
        const char* reason = nullptr;
        if (LoadEXR(&texels, &p.width, &p.height, path.c_str(), &reason) != TINYEXR_SUCCESS)
            throw error(path + ": " + one_line(reason != nullptr ? reason : "not an OpenEXR picture"));
        p.texels.reset(texels);
        return of_floats(path, p);
    }
    if (stbi_is_hdr(path.c_str()) != 0) {
        float_picture p;
        int channels = 0;
        p.texels.reset(stbi_loadf(path.c_str(), &p.width, &p.height, &channels, 4));
        if (!p.texels)
            throw error(path + ": not a picture: " + one_line(stbi_failure_reason()));
        return of_floats(path, p);
    }
    ao::texture t;
    int channels = 0;
    const std::unique_ptr<stbi_uc, freed> texels(stbi_load(path.c_str(), &t.width, &t.height, &channels, 4));
    if (!texels)
        throw error(path + ": not a picture: " + one_line(stbi_failure_reason()));
    t.srgb = true;
    t.texels = { texels.get(), std::size_t{ 4 } * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height) };
    return ao::ambient_of_environment(t);
}

} // namespace

ao::ambient_light load_environment(const std::string& path)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status))
        throw error(path + ": no such file");
    if (!std::filesystem::is_regular_file(status))
        throw error(path + ": not a regular file");
    const std::string bytes = run_apart(path, 60, [&] {
        const ao::ambient_light light = decode(path);
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

} // namespace ao::tools
