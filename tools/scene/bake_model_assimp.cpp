#include "apart.hpp"
#include "bake_model.hpp"
#include "error.hpp"

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <type_traits>

namespace ao::tools {
namespace {

void add_mesh(bake_model& m, const aiMesh& mesh, const aiMatrix4x4& to_world, const std::string& name)
{
    if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0)
        return;
    const auto base = static_cast<std::uint32_t>(m.positions.size());
    const auto object = static_cast<std::uint32_t>(m.object_names.size());
    m.object_names.push_back(name);
    const aiMatrix4x4& t = to_world;
    const glm::dmat3 axes{ glm::dvec3(t.a1, t.b1, t.c1), glm::dvec3(t.a2, t.b2, t.c2), glm::dvec3(t.a3, t.b3, t.c3) };
    const bool mirrored = glm::dot(axes[0], glm::cross(axes[1], axes[2])) < 0.0;
    const glm::dmat3 of_normals{ glm::cross(axes[1], axes[2]), glm::cross(axes[2], axes[0]), glm::cross(axes[0], axes[1]) };
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
        const aiVector3D& p = mesh.mVertices[i];
        m.positions.push_back(axes * glm::dvec3(p.x, p.y, p.z) + glm::dvec3(t.a4, t.b4, t.c4));
        glm::dvec3 normal(0.0);
        if (mesh.HasNormals())
            normal = of_normals * glm::dvec3(mesh.mNormals[i].x, mesh.mNormals[i].y, mesh.mNormals[i].z);
        const double length = glm::length(normal);
        const bool sound = std::isfinite(length) && length > 0.0;
        m.normals.push_back(sound ? glm::vec3(normal * ((mirrored ? -1.0 : 1.0) / length)) : glm::vec3(0.0f));
    }
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
        const aiFace& face = mesh.mFaces[f];
        if (face.mNumIndices != 3)
            continue;
        // Under a node that mirrors, front faces would wind the other way.
        const unsigned last = mirrored ? 1 : 2;
        m.add_polygon(std::array{ base + face.mIndices[0], base + face.mIndices[3 - last], base + face.mIndices[last] }, object);
    }
}

void add_node(bake_model& m, const aiScene& file, const aiNode& node, const aiMatrix4x4& parent)
{
    const aiMatrix4x4 to_world = parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& mesh = *file.mMeshes[node.mMeshes[i]];
        add_mesh(m, mesh, to_world, one_line(node.mName.length > 0 ? node.mName.C_Str() : mesh.mName.C_Str()));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i)
        add_node(m, file, *node.mChildren[i], to_world);
}

bake_model read_here(const std::string& path)
{
    Assimp::Importer importer;
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // Validation first, so that no later step follows an index out of range. Nothing that joins or sorts vertices.
    if (importer.ReadFile(path, aiProcess_ValidateDataStructure | aiProcess_Triangulate | aiProcess_SortByPType) == nullptr)
        throw error(path + ": " + one_line(importer.GetErrorString()));
    bake_model m;
    add_node(m, *importer.GetScene(), *importer.GetScene()->mRootNode, aiMatrix4x4());
    return m;
}

// Between the process that reads and ours.
class packer {
public:
    template <class T>
    void array(const std::vector<T>& values)
    {
        static_assert(std::is_trivially_copyable_v<T>);
        const std::uint64_t count = values.size();
        bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
        bytes.append(reinterpret_cast<const char*>(values.data()), count * sizeof(T));
    }
    std::string bytes;
};

class unpacker {
public:
    explicit unpacker(std::string_view b) : bytes(b) {}
    template <class T>
    void array(std::vector<T>& values)
    {
        std::uint64_t count = 0;
        take(&count, sizeof count);
        values.resize(static_cast<std::size_t>(count));
        take(values.data(), values.size() * sizeof(T));
    }

private:
    void take(void* to, std::size_t size)
    {
        if (size > bytes.size())
            throw error("the reader's answer is cut short");
        if (size > 0)
            std::memcpy(to, bytes.data(), size);
        bytes.remove_prefix(size);
    }
    std::string_view bytes;
};

std::string to_bytes(const bake_model& m)
{
    packer p;
    p.array(m.positions);
    p.array(m.normals);
    p.array(m.corners);
    p.array(m.first_corner);
    p.array(m.object);
    for (const std::string& name : m.object_names)
        p.bytes += name + '\n';
    return std::move(p.bytes);
}

bake_model from_bytes(const std::string& bytes)
{
    bake_model m;
    unpacker u(bytes);
    u.array(m.positions);
    u.array(m.normals);
    u.array(m.corners);
    u.array(m.first_corner);
    u.array(m.object);
    const std::uint32_t most = m.object.empty() ? 0 : *std::max_element(m.object.begin(), m.object.end());
    m.object_names.assign(std::size_t{ most } + 1, std::string());
    return m;
}

} // namespace

bake_model read_by_assimp(const std::string& path)
{
    std::error_code failure;
    const std::uintmax_t size = std::filesystem::file_size(path, failure);
    const auto seconds = static_cast<unsigned>(std::min<std::uintmax_t>(60 + size / 500'000, 3600));
    return from_bytes(run_apart(path, seconds, [&] { return to_bytes(read_here(path)); }));
}

} // namespace ao::tools
