#include "bake_rays.hpp"

#include "ao/bake_passes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace ao::cpu::detail {

namespace {

using pass = bake_pass<float>;

class through_tree final : public bake_ray_shooter {
public:
    through_tree(const bake_kernel_table& kernels, const bake_group& group) : kernels_(kernels), group_(group) {}
    void shoot(const bake_ray_task& rays, std::size_t receiver, std::size_t first, std::size_t last, const bake_view& view,
               float* seconds) const override
    {
        bake_ray_task with_tree = rays;
        with_tree.nodes = group_.nodes;
        kernels_.trace(group_.task, with_tree, receiver, first, last, view, seconds);
    }

private:
    const bake_kernel_table& kernels_;
    const bake_group& group_;
};

// The parts of all lines apart.
struct line_arrays {
    std::array<std::vector<float>, 11> parts;

    explicit line_arrays(const std::vector<bake_line>& lines)
    {
        for (const bake_line& l : lines) {
            const float values[]{ l.ux, l.uy, l.uz, l.wx, l.wy, l.wz, l.dx, l.dy, l.dz, l.weight, l.opposite };
            for (std::size_t i = 0; i < parts.size(); ++i) {
                parts[i].push_back(values[i]);
            }
        }
        for (auto& part : parts) {
            part.insert(part.end(), bake_padding, 0.0F);
        }
    }
};

struct vertex_memory {
    std::vector<float> open;
    std::vector<float> cosine;
    std::vector<float> seconds;
};

std::vector<vertex_memory> make_memories(const threads& workers, std::size_t lines)
{
    std::vector<vertex_memory> memories(static_cast<std::size_t>(workers.count()));
    for (vertex_memory& m : memories) {
        m.open.resize(lines + bake_padding);
        m.cosine.resize(lines + bake_padding);
        m.seconds.resize(lines + bake_padding);
    }
    return memories;
}

bake_ray_task rays_along(const line_arrays& lines)
{
    bake_ray_task rays;
    for (std::size_t i = 0; i < lines.parts.size(); ++i) {
        rays.lines[i] = lines.parts[i].data();
    }
    return rays;
}

struct vertex_taker {
    const bake_job& job;
    const bake_group& group;
    const bake_ray_shooter& shooter;
    const bake_ray_task& rays;

    bake_sum take(std::size_t receiver, std::size_t first, std::size_t last, vertex_memory& m) const
    {
        const std::size_t vertex = group.vertices[receiver];
        bake_ray_task turned = rays;
        pass::ao_rotation turn{};
        float rows[9];
        if (job.turned()) {
            turn = vertex_rotation(job, vertex);
            const float values[9]{ turn.xx, turn.xy, turn.xz, turn.yx, turn.yy, turn.yz, turn.zx, turn.zy, turn.zz };
            std::copy(values, values + 9, rows);
            turned.turn = rows;
        }
        shooter.shoot(turned, receiver, first, last, { m.open.data(), m.cosine.data() }, m.seconds.data());
        bake_sum sum;
        float last_cosine = 0;
        float last_open = 1;
        for (std::size_t i = first; i < last; ++i) {
            const bool both = job.lines[i].opposite > 0;
            const float cosine = m.cosine[i];
            const bool looks = cosine >= 0 || both;
            if (looks) {
                add(sum, i, cosine < 0 ? -1.0F : 1.0F, cosine, m.open[i], turn);
            }
            if (cosine == 0 && both) {
                add(sum, i, -1, cosine, m.seconds[i], turn);
            }
            const float counted = looks ? cosine : 0.0F;
            if (i % 2 == 1 && last_cosine * counted > 0) {
                sum.changes += static_cast<std::int32_t>(pass::ao_bake_change(last_open, m.open[i], counted, job.by_cosine));
            }
            last_cosine = counted;
            last_open = m.open[i];
        }
        return sum;
    }

    void add(bake_sum& sum, std::size_t i, float sign, float cosine, float open, const pass::ao_rotation& turn) const
    {
        const bake_line& l = job.lines[i];
        const float weight = pass::ao_bake_weight(l.weight, cosine * sign, job.by_cosine);
        const float part = pass::ao_bake_part(weight, open);
        sum.all += static_cast<std::int32_t>(weight);
        sum.open += static_cast<std::int32_t>(part);
        sum.count += cosine != 0 ? 1 : 0;
        if (job.settings.bent_normals) {
            const bake_line turned = job.turned() ? pass::ao_bake_turned(turn, l) : l;
            sum.x += static_cast<std::int32_t>(pass::ao_bake_part(part, turned.dx * sign));
            sum.y += static_cast<std::int32_t>(pass::ao_bake_part(part, turned.dy * sign));
            sum.z += static_cast<std::int32_t>(pass::ao_bake_part(part, turned.dz * sign));
        }
    }
};

} // namespace

make_bake_shooter tree_shooter(const bake_kernel_table& kernels)
{
    return [&kernels](const bake_group& group) -> result<std::unique_ptr<bake_ray_shooter>> {
        return std::unique_ptr<bake_ray_shooter>(new through_tree(kernels, group));
    };
}

void add_rays(const bake_job& job, const bake_group& group, const bake_kernel_table& kernels,
              const std::vector<std::uint32_t>& receivers, std::size_t first, std::size_t last, threads& workers, bake_sums& sums)
{
    const line_arrays lines(job.lines);
    const bake_ray_task rays = rays_along(lines);
    std::vector<vertex_memory> memories = make_memories(workers, job.lines.size());
    const through_tree shooter(kernels, group);
    const vertex_taker taker{ job, group, shooter, rays };
    workers.over(static_cast<int>(receivers.size()), [&](int begin, int end) {
        vertex_memory& memory = memories[workers.own_index()];
        for (int i = begin; i < end; ++i) {
            const std::uint32_t receiver = receivers[static_cast<std::size_t>(i)];
            sums.sums[group.vertices[receiver] - sums.first_vertex] += taker.take(receiver, first, last, memory);
        }
    });
}

result<success> bake_by_vertices(const bake_job& job, const bake_request& request, const make_bake_shooter& make,
                                 threads& workers, bake_sums& sums)
{
    const std::vector<std::uint32_t> objects = separate_objects(job);
    const line_arrays lines(job.lines);
    const bake_ray_task rays = rays_along(lines);
    std::vector<vertex_memory> memories = make_memories(workers, job.lines.size());
    // One after the other in the order of vertices, so that what is done is a range: by far more vertices than threads at a time.
    const std::size_t wanted = sums.last_vertex - sums.first_vertex;
    const bool whole = !request.progress && objects.empty();
    const std::size_t batch = whole ? std::max<std::size_t>(wanted, 1)
                                    : std::max<std::size_t>({ wanted / 64, 16 * static_cast<std::size_t>(workers.count()),
                                                              objects.empty() ? 1 : wanted });
    for (std::size_t done = 0; done < wanted;) {
        const std::size_t next = std::min(wanted, done + batch);
        for (std::size_t g = 0; g < std::max<std::size_t>(1, objects.size()); ++g) {
            const bake_group group = make_bake_group(job, sums.first_vertex + done, sums.first_vertex + next,
                                                     objects.empty() ? nullptr : &objects[g], true);
            if (group.vertices.empty()) {
                continue;
            }
            const auto shooter = make(group);
            if (!shooter) {
                return shooter.error();
            }
            const vertex_taker taker{ job, group, **shooter, rays };
            workers.over(static_cast<int>(group.vertices.size()), [&](int first, int last) {
                vertex_memory& memory = memories[workers.own_index()];
                for (int i = first; i < last; ++i) {
                    const auto receiver = static_cast<std::size_t>(i);
                    sums.sums[group.vertices[receiver] - sums.first_vertex] =
                        taker.take(receiver, sums.first_line, sums.last_line, memory);
                }
            });
        }
        done = next;
        if (request.progress && !request.progress(static_cast<double>(done) / static_cast<double>(wanted)) && done < wanted) {
            sums.last_vertex = sums.first_vertex + done;
            sums.sums.resize(done);
            break;
        }
    }
    return success{};
}

} // namespace ao::cpu::detail
