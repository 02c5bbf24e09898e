#pragma once

#include "materials.hpp"

#include <assimp/scene.h>
#include <glm/mat3x3.hpp>

namespace ao::tools {

// Makes a scene of what Assimp has read, validated and triangulated. Warnings go to the scene.
class model_reader {
public:
    // The scene has nothing yet but its name, the path of the model.
    model_reader(const aiScene& from, scene& to) : file(from), s(to) {}

    // Materials first: meshes depend on what theirs need.
    void read_materials();
    void read_meshes();

private:
    void embed_textures(texture_shelf& shelf) const;
    void add_node(const aiNode& node, const aiMatrix4x4& parent_to_world);
    void add_mesh(const aiMesh& mesh, const aiMatrix4x4& to_world, const std::string& object_name);
    std::uint32_t drawn_material(const aiMesh& mesh, bool has_uvs, const std::string& object_name);
    bool add_uvs(const aiMesh& mesh);
    bool add_own_tangents(const aiMesh& mesh, const glm::dmat3& to_world, std::size_t first_vertex) const;

    const aiScene& file;
    scene& s;
    std::vector<read_material> materials;
    std::vector<int> unmapped; // by material: its copy without maps, where one was needed; else -1
    bool with_tangents = false;
};

} // namespace ao::tools
