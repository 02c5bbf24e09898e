#include "load.hpp"

#include "apart.hpp"
#include "error.hpp"
#include "scene_bytes.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace ao::tools {
namespace {

glm::vec3 to_vec3(const aiVector3D& v)
{
    return { v.x, v.y, v.z };
}

bool finite(const aiVector3D& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Before the vertices of the file are joined and transformed: an index that means something to whoever wrote the file.
void check_vertices(const std::string& path, const aiScene& file)
{
    for (unsigned m = 0; m < file.mNumMeshes; ++m) {
        const aiMesh& mesh = *file.mMeshes[m];
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const bool position = finite(mesh.mVertices[i]);
            if (position && (!mesh.HasNormals() || finite(mesh.mNormals[i])))
                continue;
            throw error(path + ": vertex " + std::to_string(i) + " of mesh " + std::to_string(m) + " '" +
                        one_line(mesh.mName.C_Str()) + "': " + (position ? "normal" : "position") + " is not finite");
        }
    }
}

// A vertex without a direction becomes one vertex per face around it, with that face's normal.
void split_undirected(scene& s, std::size_t first_triangle)
{
    for (std::size_t t = first_triangle; t < s.triangles.size(); ++t) {
        const glm::uvec3 corners = s.triangles[t];
        const glm::dvec3 a = s.positions[corners.x];
        const glm::dvec3 cross = glm::cross(glm::dvec3(s.positions[corners.y]) - a, glm::dvec3(s.positions[corners.z]) - a);
        const double length = glm::length(cross);
        const glm::vec3 face = length > 0.0 ? glm::vec3(cross / length) : glm::vec3(0.0f, 1.0f, 0.0f);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t v = corners[corner];
            if (s.normals[v] != glm::vec3(0.0f))
                continue;
            s.triangles[t][corner] = static_cast<std::uint32_t>(s.positions.size());
            s.positions.push_back(glm::vec3(s.positions[v]));
            s.normals.push_back(face);
        }
    }
    // What the loop left behind is used by no triangle.
    for (glm::vec3& n : s.normals)
        if (n == glm::vec3(0.0f))
            n = glm::vec3(0.0f, 1.0f, 0.0f);
}

glm::vec3 unit_or_zero(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(v / length) : glm::vec3(0.0f);
}

void add_mesh(scene& s, const aiMesh& mesh, const aiMatrix4x4& to_world, const std::string& object_name)
{
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0)
        return;
    const auto base = static_cast<std::uint32_t>(s.positions.size());
    const auto first_triangle = s.triangles.size();
    const auto object = static_cast<std::uint32_t>(s.object_names.size());
    s.object_names.push_back(object_name);

    // Normals go by the inverse transpose, here as cross products of the columns so that a flat node (scale 0) is no
    // division by zero.
    const glm::dvec3 x{ to_world.a1, to_world.b1, to_world.c1 };
    const glm::dvec3 y{ to_world.a2, to_world.b2, to_world.c2 };
    const glm::dvec3 z{ to_world.a3, to_world.b3, to_world.c3 };
    const double side = glm::dot(x, glm::cross(y, z)) < 0.0 ? -1.0 : 1.0;
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        s.positions.push_back(to_vec3(to_world * mesh.mVertices[i]));
        glm::dvec3 normal{ 0.0 };
        if (mesh.HasNormals()) {
            const aiVector3D& n = mesh.mNormals[i];
            normal = side * (glm::cross(y, z) * static_cast<double>(n.x) + glm::cross(z, x) * static_cast<double>(n.y) +
                             glm::cross(x, y) * static_cast<double>(n.z));
        }
        s.normals.push_back(unit_or_zero(normal));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3)
            continue;
        s.triangles.push_back({ base + face.mIndices[0], base + face.mIndices[1], base + face.mIndices[2] });
        s.object.push_back(object);
        s.material.push_back(mesh.mMaterialIndex);
    }
    split_undirected(s, first_triangle);
}

void add_node(scene& s, const aiScene& file, const aiNode& node, const aiMatrix4x4& parent_to_world)
{
    const aiMatrix4x4 to_world = parent_to_world * node.mTransformation;
    for (unsigned m = 0; m < node.mNumMeshes; ++m) {
        const aiMesh& mesh = *file.mMeshes[node.mMeshes[m]];
        const std::string node_name = node.mName.C_Str();
        const std::string mesh_name = mesh.mName.C_Str();
        add_mesh(s, mesh, to_world, one_line(node_name.empty() ? mesh_name : node_name));
    }
    for (unsigned c = 0; c < node.mNumChildren; ++c)
        add_node(s, file, *node.mChildren[c], to_world);
}

// Returns the size in bytes.
std::uintmax_t check_file(const std::string& path)
{
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (status.type() == std::filesystem::file_type::not_found)
        throw error(path + ": no such file");
    if (failure)
        throw error(path + ": " + failure.message());
    if (!std::filesystem::is_regular_file(status))
        throw error(path + ": not a regular file");
    const auto size = std::filesystem::file_size(path, failure);
    if (failure)
        throw error(path + ": " + failure.message());
    if (size == 0)
        throw error(path + ": the file is empty");
    return size;
}

// Assimp 5.2 reads a PLY header that never ends for ever.
void check_ply_header(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::string start(1 << 16, '\0');
    file.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(file.gcount()));
    if (start.rfind("ply", 0) == 0 && start.find("end_header") == std::string::npos)
        throw error(path + ": truncated, the PLY header has no end");
}

scene read_model(const std::string& path)
{
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    const auto fail = [&] { throw error(path + ": " + one_line(importer.GetErrorString())); };

    // Validation runs first, so that no later step follows an index out of range.
    if (importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType) == nullptr)
        fail();
    if (importer.GetScene()->mNumMeshes == 0)
        throw error(path + ": no triangles");
    check_vertices(path, *importer.GetScene());
    if (importer.ApplyPostProcessing(aiProcess_GenNormals | aiProcess_JoinIdenticalVertices) == nullptr)
        fail();

    const aiScene& file = *importer.GetScene();
    scene s;
    s.name = path;
    for (unsigned m = 0; m < file.mNumMaterials; ++m)
        s.material_names.push_back(one_line(file.mMaterials[m]->GetName().C_Str()));
    if (s.material_names.empty())
        s.material_names.push_back("default");
    add_node(s, file, *file.mRootNode, aiMatrix4x4());
    check(s);
    return s;
}

} // namespace

scene load_model(const std::string& path)
{
    const std::uintmax_t size = check_file(path);
    check_ply_header(path);
    const auto seconds = static_cast<unsigned>(std::min<std::uintmax_t>(30 + size / 500'000, 3600));
    return scene_from_bytes(run_apart(path, seconds, [&] { return to_bytes(read_model(path)); }));
}

} // namespace ao::tools
