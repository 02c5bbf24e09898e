#include "bake_lines.hpp"

#include "bake_closed.hpp"
#include "bake_memory.hpp"
#include "bake_rays.hpp"

#include "ao/bake_passes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace ao::cpu::detail {

namespace {

using pass = bake_pass<float>;

bake_sum sum_of(const bake_totals& t, std::size_t i)
{
    return { t.parts[0][i], t.parts[1][i], t.parts[2][i], t.parts[3][i], t.parts[4][i], t.parts[5][i], t.parts[6][i], 0 };
}

// The ground is nearer, or what was found.
float with_ground(const bake_job& job, const bake_line& line, std::uint32_t vertex, float sign, float open)
{
    const float distance = pass::ao_bake_ground(job.ground, line, job.mesh.vertices[vertex].start, sign);
    if (!(distance >= 0 && distance <= job.reach)) {
        return open;
    }
    return std::min(open, pass::ao_bake_openness(distance, job.reach, static_cast<int>(job.settings.falloff)));
}

struct line_taker {
    const bake_job& job;
    const bake_group& group;
    const bake_kernel_table& kernels;
    bool raster;

    // Lines first and first + 1, or the last one.
    void take(bake_line_memory& m, std::size_t first, std::size_t last) const
    {
        const int count = last - first > 1 ? 2 : 1;
        for (int k = 0; k < count; ++k) {
            const bake_line& line = job.lines[first + static_cast<std::size_t>(k)];
            see(m, line, m.views[k]);
            add_seconds(m, line);
        }
        kernels.add(group.task, &job.lines[first], m.views, count, m.totals, 0, group.task.receivers.count);
    }

    void see(bake_line_memory& m, const bake_line& line, const bake_view& view) const
    {
        const std::size_t receivers = group.task.receivers.count;
        if (raster) {
            kernels.raster(group.task, line, m.raster, view);
            m.second_count = m.raster.second_count;
        }
        else {
            kernels.brute(group.task, line, m.brute, view, 0, receivers, m.seconds.data(), m.second_count);
        }
        if (!job.settings.ground) {
            return;
        }
        for (std::size_t i = 0; i < receivers; ++i) {
            view.open[i] = with_ground(job, line, group.vertices[i], view.cosine[i] >= 0 ? 1.0F : -1.0F, view.open[i]);
        }
        for (std::size_t k = 0; k < m.second_count; ++k) {
            m.seconds[k].open = with_ground(job, line, group.vertices[m.seconds[k].receiver], -1.0F, m.seconds[k].open);
        }
    }

    // The half that looks along -d where the normal is across the line.
    void add_seconds(bake_line_memory& m, const bake_line& line) const
    {
        for (std::size_t k = 0; k < m.second_count; ++k) {
            const std::size_t i = m.seconds[k].receiver;
            const float weight = pass::ao_bake_weight(line.weight, 0.0F, group.task.options.by_cosine);
            const float part = pass::ao_bake_part(weight, m.seconds[k].open);
            m.totals.parts[0][i] += static_cast<std::int32_t>(part);
            m.totals.parts[1][i] += static_cast<std::int32_t>(weight);
            if (group.task.options.bent) {
                m.totals.parts[4][i] += static_cast<std::int32_t>(pass::ao_bake_part(part, -line.dx));
                m.totals.parts[5][i] += static_cast<std::int32_t>(pass::ao_bake_part(part, -line.dy));
                m.totals.parts[6][i] += static_cast<std::int32_t>(pass::ao_bake_part(part, -line.dz));
            }
        }
    }
};

} // namespace

void bake_by_lines(const bake_job& job, const bake_request& request, const bake_kernel_table& kernels, threads& workers,
                   bake_sums& sums)
{
    std::vector<std::uint32_t> objects = separate_objects(job);
    const std::size_t groups = std::max<std::size_t>(1, objects.size());
    const std::size_t pairs = (sums.last_line - sums.first_line + 1) / 2;
    // Groups must end at the same line: their share of the progress is the line they end at.
    std::vector<bake_group> made;
    for (std::size_t g = 0; g < groups; ++g) {
        made.push_back(make_bake_group(job, sums.first_vertex, sums.last_vertex, objects.empty() ? nullptr : &objects[g], false));
        if (made.back().vertices.empty()) {
            made.pop_back();
        }
        else if (sums.route == bake_route::raster) {
            add_corner_places(made.back());
            if (objects.empty() && is_plain(made.back().task.options)) {
                find_closed_surfaces(made.back());
            }
        }
    }
    std::vector<std::vector<std::unique_ptr<bake_line_memory>>> memories(made.size());
    for (auto& of_group : memories) {
        of_group.resize(static_cast<std::size_t>(workers.count()));
    }
    // At least 64 calls of progress a bake where there is one, and not so few lines that threads wait.
    const std::size_t batch =
        request.progress ? std::max<std::size_t>(pairs / 64, 4 * static_cast<std::size_t>(workers.count())) : pairs;
    std::size_t done = 0;
    while (done < pairs) {
        const std::size_t next = std::min(pairs, done + batch);
        for (std::size_t g = 0; g < made.size(); ++g) {
            const line_taker taker{ job, made[g], kernels, sums.route == bake_route::raster };
            workers.over(static_cast<int>(next - done), [&](int first, int last) {
                auto& memory = memories[g][workers.own_index()];
                if (!memory) {
                    memory = std::make_unique<bake_line_memory>(made[g].task, taker.raster);
                }
                for (int i = first; i < last; ++i) {
                    const std::size_t line = sums.first_line + 2 * (done + static_cast<std::size_t>(i));
                    taker.take(*memory, line, std::min(line + 2, sums.last_line));
                }
            });
        }
        for (const bake_group& group : made) {
            if (!group.apart.empty()) {
                add_rays(job, group, kernels, group.apart, sums.first_line + 2 * done,
                         std::min(sums.first_line + 2 * next, sums.last_line), workers, sums);
            }
        }
        done = next;
        if (request.progress && !request.progress(static_cast<double>(done) / static_cast<double>(pairs))) {
            break;
        }
    }
    sums.last_line = std::min(sums.last_line, sums.first_line + 2 * done);
    for (std::size_t g = 0; g < made.size(); ++g) {
        std::vector<bool> by_rays(made[g].vertices.size());
        for (const std::uint32_t receiver : made[g].apart) {
            by_rays[receiver] = true;
        }
        for (const auto& memory : memories[g]) {
            for (std::size_t i = 0; memory && i < made[g].vertices.size(); ++i) {
                if (by_rays[i]) {
                    continue;
                }
                sums.sums[made[g].vertices[i] - sums.first_vertex] += sum_of(memory->totals, i);
            }
        }
    }
}

} // namespace ao::cpu::detail
