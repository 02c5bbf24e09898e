#pragma once

#include <glm/vec3.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ao::tools {

// A model for values per vertex: its vertices in the file's own order, neither joined nor split, so that value i is vertex i's.
// Positions in double: georeferenced models need it. May hold vertices that no face uses, that are not finite or lie together.
struct bake_model {
    std::string name; // path
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;          // one per position, 0 where the file has none; or none at all
    std::vector<std::uint32_t> corners;      // of polygons, counter-clockwise
    std::vector<std::uint32_t> first_corner; // of each polygon; one more at the end
    std::vector<std::uint32_t> object;       // of each polygon, index into object_names
    std::vector<std::string> object_names;   // at least one

    [[nodiscard]] std::size_t polygons() const { return first_corner.empty() ? 0 : first_corner.size() - 1; }
    [[nodiscard]] std::span<const std::uint32_t> polygon(std::size_t i) const
    {
        return std::span(corners).subspan(first_corner[i], first_corner[i + 1] - first_corner[i]);
    }
    // Fewer than three corners: nothing is added. Throws `error` beyond 2^32 corners in all.
    void add_polygon(std::span<const std::uint32_t> of, std::uint32_t of_object);
};

// What a bake reads.
struct bake_triangles {
    std::vector<std::uint32_t> indices; // three a triangle
    std::vector<std::uint32_t> objects; // of each triangle
};

// Polygons as fans from a corner where that is sound, else by cutting ears: the same surface for any flat polygon without
// crossings.
[[nodiscard]] bake_triangles triangles_of(const bake_model& model);

// PLY and OBJ by readers of our own: every vertex is one line or record of the file. OBJ: object and group lines begin objects,
// a vertex's normal is the mean of those of its corners. Anything else by Assimp: all vertices of all meshes as Assimp has them,
// node by node, in world space; an object per node and mesh. Throws `error`: a file that is missing, empty, cut short or broken,
// without triangles, or with an index out of range.
[[nodiscard]] bake_model load_bake_model(const std::string& path);

// Throws `error` with the file's name. In a child process.
[[nodiscard]] bake_model read_by_assimp(const std::string& path);
// The bytes of a whole file. Throw `error` without its name.
[[nodiscard]] bake_model read_ply(std::string_view bytes);
[[nodiscard]] bake_model read_obj(std::string_view bytes);

} // namespace ao::tools
