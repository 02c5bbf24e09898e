#include "bake_memory.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ao::cpu::detail {

namespace {

constexpr std::size_t tile_floats = 2 * 65 * 65;

// Along Morton's curve in space.
std::uint64_t place_in_space(const glm::vec3& p)
{
    const auto spread = [](float x) {
        auto bits = static_cast<std::uint64_t>(std::clamp((x + 1.0F) * 0.5F, 0.0F, 1.0F) * 1048575.0F);
        bits = (bits | (bits << 32U)) & 0x1f00000000ffffU;
        bits = (bits | (bits << 16U)) & 0x1f0000ff0000ffU;
        bits = (bits | (bits << 8U)) & 0x100f00f00f00f00fU;
        bits = (bits | (bits << 4U)) & 0x10c30c30c30c30c3U;
        return (bits | (bits << 2U)) & 0x1249249249249249U;
    };
    return spread(p.x) | (spread(p.y) << 1U) | (spread(p.z) << 2U);
}

} // namespace

std::vector<std::uint32_t> separate_objects(const bake_job& job)
{
    std::vector<std::uint32_t> objects;
    if (job.settings.occluders != bake_occluders::all) {
        objects = job.mesh.objects;
        std::sort(objects.begin(), objects.end());
        objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
    }
    return objects;
}

bake_group make_bake_group(const bake_job& job, std::size_t first, std::size_t last, const std::uint32_t* object, bool tree)
{
    const bake_mesh& m = job.mesh;
    bake_group group;
    for (std::size_t v = first; v < last; ++v) {
        if ((m.flags[v] & bake_unbaked) == 0 && (object == nullptr || m.vertex_objects[v] == *object)) {
            group.vertices.push_back(static_cast<std::uint32_t>(v));
        }
    }
    std::vector<std::uint64_t> places(group.vertices.size());
    std::vector<std::uint32_t> order(group.vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i] = place_in_space(m.vertices[group.vertices[i]].start);
    }
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return places[a] < places[b]; });
    std::vector<std::uint32_t> sorted;
    for (const std::uint32_t i : order) {
        sorted.push_back(group.vertices[i]);
    }
    group.vertices = std::move(sorted);
    for (const std::uint32_t v : group.vertices) {
        group.starts.push_back(m.vertices[v].start);
        group.normals.push_back(m.vertices[v].normal);
    }
    for (const glm::vec3& p : m.points) {
        group.points.push_back(p);
    }
    std::vector<bake_triangle> some;
    for (std::size_t i = 0; object != nullptr && i < m.triangles.size(); ++i) {
        if ((m.objects[i] == *object) == (job.settings.occluders == bake_occluders::own_object)) {
            some.push_back(m.triangles[i]);
        }
    }
    if (object != nullptr && tree) {
        group.own_tree = build_bake_tree(m.points, some);
        std::vector<bake_triangle> by_leaves;
        for (const std::uint32_t i : group.own_tree.order) {
            by_leaves.push_back(some[i]);
        }
        some = std::move(by_leaves);
    }
    for (const bake_triangle& t : object != nullptr ? some : m.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            group.corners[k].push_back(static_cast<std::int32_t>(t[k]));
        }
    }
    group.nodes = object != nullptr ? group.own_tree.nodes.data() : m.tree.nodes.data();
    bake_task& task = group.task;
    task.receivers.count = group.vertices.size();
    task.occluders.point_count = m.points.size();
    task.occluders.triangle_count = group.corners[0].size();
    group.starts.pad();
    group.normals.pad();
    group.points.pad();
    for (std::size_t k = 0; k < 3; ++k) {
        group.corners[k].insert(group.corners[k].end(), bake_padding, 0);
        task.occluders.corners[k] = group.corners[k].data();
    }
    task.receivers.starts = group.starts.view();
    task.receivers.normals = group.normals.view();
    task.occluders.points = group.points.view();
    bake_options& o = task.options;
    o.reach = job.reach;
    o.limited = static_cast<double>(job.reach) < 1.01 * m.diagonal;
    o.falloff = static_cast<int>(job.settings.falloff);
    o.front = job.settings.sides == bake_sides::front;
    o.by_cosine = job.by_cosine;
    o.bent = job.settings.bent_normals;
    o.ground = job.settings.ground;
    for (int i = 0; i < 4; ++i) {
        o.ground_plane[i] = job.ground[i];
    }
    return group;
}

void add_corner_places(bake_group& group)
{
    for (std::size_t k = 0; k < 3; ++k) {
        bake_vector_arrays& places = group.places[k];
        for (std::size_t i = 0; i < group.task.occluders.triangle_count; ++i) {
            const auto p = static_cast<std::size_t>(group.corners[k][i]);
            places.push_back({ group.points.x[p], group.points.y[p], group.points.z[p] });
        }
        places.pad();
        group.task.occluders.places[k] = places.view();
    }
}

float* bake_line_memory::floats(std::size_t count)
{
    return float_arrays_.emplace_back(count + bake_padding).data();
}

std::int32_t* bake_line_memory::words(std::size_t count)
{
    return word_arrays_.emplace_back(count + bake_padding).data();
}

bake_line_memory::bake_line_memory(const bake_task& task, bool with_raster)
{
    const std::size_t receivers = task.receivers.count;
    const std::size_t points = task.occluders.point_count;
    seconds.resize(receivers + 1);
    const auto seen = [&](std::size_t count) { return bake_seen{ floats(count), floats(count), floats(count) }; };
    for (bake_view& view : views) {
        view = { floats(receivers), floats(receivers) };
    }
    for (std::int32_t*& part : totals.parts) {
        part = words(receivers);
    }
    if (!with_raster) {
        brute.points = seen(points);
        for (float*& corner : brute.corners) {
            corner = floats(task.occluders.triangle_count);
        }
        return;
    }
    raster.starts = seen(receivers);
    const std::size_t samples = 2 * receivers + 3 * bake_padding;
    raster.samples = seen(samples);
    raster.receivers = words(samples);
    raster.cells = words(receivers);
    raster.tiles = words(receivers);
    raster.toward = floats(receivers);
    // Rows about as high as triangles are, columns finer: measured.
    const double side = std::sqrt(static_cast<double>(receivers));
    raster.rows = std::clamp(static_cast<int>(side * 0.3), 1, 4096);
    raster.columns = std::clamp(static_cast<int>(side * 2.0), 1, 8192);
    raster.tiles_across = std::clamp(static_cast<int>(side * 0.4), 1, 64);
    raster.first = words(2 * (static_cast<std::size_t>(raster.rows) * static_cast<std::size_t>(raster.columns) + 1) + 2);
    raster.tile_depths = floats(tile_floats);
    hit_.resize(samples / 64 + 4);
    raster.hit = hit_.data();
    if (task.options.falloff != 0) {
        raster.distances = floats(samples);
    }
    raster.seconds = seconds.data();
}

} // namespace ao::cpu::detail
