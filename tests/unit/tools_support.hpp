#pragma once

#include "scene/camera.hpp"
#include "scene/mesh_builder.hpp"

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <unistd.h>

#ifndef AO_DOCS
#define AO_DOCS ""
#endif

// A directory of its own for one test, gone afterwards.
class scratch_directory {
public:
    scratch_directory()
    {
        static int number = 0;
        path =
            std::filesystem::temp_directory_path() / ("ao_tools_" + std::to_string(::getpid()) + "_" + std::to_string(number++));
        std::filesystem::create_directories(path);
    }
    scratch_directory(const scratch_directory&) = delete;
    scratch_directory& operator=(const scratch_directory&) = delete;
    ~scratch_directory() { std::filesystem::remove_all(path); }

    std::string file(const std::string& name, std::string_view text) const
    {
        std::ofstream(path / name, std::ios::binary) << text;
        return (path / name).string();
    }

    std::filesystem::path path;
};

inline std::string read_all(const std::filesystem::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(in), {} };
}

// The JSON behind the comment "example: NAME" in docs/scenes.md. AO_DOCS is the directory.
inline std::string documented_example(const std::string& name)
{
    const std::string text = read_all(std::filesystem::path(AO_DOCS) / "scenes.md");
    const std::size_t start = text.find("```json\n", text.find("<!-- example: " + name + " -->")) + 8;
    return text.substr(start, text.find("```", start) - start);
}

inline std::size_t files_in(const std::filesystem::path& directory)
{
    const auto all = std::filesystem::directory_iterator(directory);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

// y = 0, `half` to every side of the origin.
inline void add_floor(ao::tools::scene& s, float half)
{
    ao::tools::mesh_builder m(s);
    m.begin("floor", "any");
    m.quad({ -half, 0.0f, half }, { half, 0.0f, half }, { half, 0.0f, -half }, { -half, 0.0f, -half });
}

// From `height` straight down on (x, z); the picture's columns run along x, its top toward -z.
inline ao::tools::camera camera_above(float x, float height, float z, float fov)
{
    ao::tools::camera c;
    c.eye = { x, height, z };
    c.pitch = -90.0f;
    c.fov = fov;
    return c;
}
