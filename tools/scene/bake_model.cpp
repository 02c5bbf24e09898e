#include "bake_model.hpp"

#include "error.hpp"

#include <glm/vec3.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

namespace ao::tools {
namespace {

namespace fs = std::filesystem;

std::string lower_suffix(const std::string& path)
{
    std::string suffix = fs::path(path).extension().string();
    for (char& c : suffix)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suffix;
}

std::string read_whole(const std::string& path)
{
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::not_found)
        throw error(path + ": no such file");
    if (failure)
        throw error(path + ": " + failure.message());
    if (!fs::is_regular_file(status))
        throw error(path + ": not a regular file");
    const std::uintmax_t size = fs::file_size(path, failure);
    if (failure)
        throw error(path + ": " + failure.message());
    if (size == 0)
        throw error(path + ": the file is empty");
    std::string bytes(static_cast<std::size_t>(size), '\0');
    std::ifstream file(path, std::ios::binary);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        throw error(path + ": cannot be read");
    return bytes;
}

} // namespace

bake_model load_bake_model(const std::string& path)
{
    const std::string suffix = lower_suffix(path);
    bake_model m;
    const std::string bytes = read_whole(path);
    try {
        if (suffix == ".obj")
            m = read_obj(bytes);
        else if (suffix == ".ply" || bytes.rfind("ply", 0) == 0)
            m = read_ply(bytes);
    } catch (const error& e) {
        throw error(path + ": " + e.what());
    }
    if (suffix != ".obj" && suffix != ".ply" && bytes.rfind("ply", 0) != 0)
        m = read_by_assimp(path);
    if (m.polygons() == 0)
        throw error(path + ": no triangles");
    if (std::none_of(m.normals.begin(), m.normals.end(), [](const glm::vec3& n) { return n != glm::vec3(0.0f); }))
        m.normals.clear();
    if (m.object_names.empty())
        m.object_names.emplace_back("model");
    m.name = path;
    return m;
}

} // namespace ao::tools
