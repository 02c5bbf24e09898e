// Meshes of Debian's package libcgal-demo: holes, parts apart, doubled places, polygons, slivers, faces without area.
#pragma once

#include "core_bake_meshes.hpp"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace bake_test {

inline constexpr const char* cgal_archive = "/usr/share/doc/libcgal-dev/data.tar.gz";

// An ASCII OFF file; polygons become fans.
inline std::optional<mesh> read_off(const std::filesystem::path& file)
{
    std::ifstream stored(file);
    std::stringstream in;
    for (std::string line; std::getline(stored, line);) {
        in << line.substr(0, line.find('#')) << '\n';
    }
    std::string head;
    std::size_t vertices = 0;
    std::size_t faces = 0;
    std::size_t edges = 0;
    if (!(in >> head >> vertices >> faces >> edges) || head != "OFF") {
        return std::nullopt;
    }
    mesh m;
    for (std::size_t i = 0; i < vertices; ++i) {
        glm::dvec3 p(0.0);
        in >> p.x >> p.y >> p.z;
        m.positions.push_back(p);
    }
    std::string line;
    for (std::size_t i = 0; i < faces && in;) {
        std::getline(in, line);
        std::istringstream words(line);
        std::size_t corners = 0;
        if (!(words >> corners)) {
            continue;
        }
        std::vector<std::uint32_t> face(corners);
        for (std::uint32_t& corner : face) {
            words >> corner;
        }
        for (std::size_t k = 2; words && k < corners; ++k) {
            m.indices.insert(m.indices.end(), { face[0], face[k - 1], face[k] });
        }
        i += words ? 1 : faces;
    }
    return in && !m.indices.empty() ? std::optional(m) : std::nullopt;
}

// A folder with meshes of the archive, removed with its owner.
class cgal_folder {
public:
    // Nothing where the package is not installed.
    static std::optional<cgal_folder> unpack(const std::vector<std::string>& names)
    {
        std::error_code none;
        if (!std::filesystem::exists(cgal_archive, none)) {
            return std::nullopt;
        }
        cgal_folder made(std::filesystem::temp_directory_path() / ("ao_cgal_meshes_" + std::to_string(getpid())));
        std::filesystem::create_directories(made.at_);
        std::vector<std::string> words{ "tar", "-xzf", cgal_archive, "-C", made.at_.string(), "--strip-components=2" };
        for (const std::string& name : names) {
            words.push_back("data/meshes/" + name);
        }
        std::vector<char*> arguments;
        for (std::string& word : words) {
            arguments.push_back(word.data());
        }
        arguments.push_back(nullptr);
        const pid_t child = fork();
        if (child == 0) {
            execvp("tar", arguments.data());
            _exit(127);
        }
        int status = 1;
        if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
            return std::nullopt;
        }
        return made;
    }
    cgal_folder(const cgal_folder&) = delete;
    cgal_folder(cgal_folder&& other) noexcept { std::swap(at_, other.at_); }
    cgal_folder& operator=(cgal_folder&&) = delete;
    ~cgal_folder()
    {
        std::error_code none;
        if (!at_.empty()) {
            std::filesystem::remove_all(at_, none);
        }
    }
    std::optional<mesh> read(const std::string& name) const { return read_off(at_ / name); }

private:
    explicit cgal_folder(std::filesystem::path at) : at_(std::move(at)) {}
    std::filesystem::path at_;
};

} // namespace bake_test
