#include "ao/bake_work.hpp"

#include "ao/outcome.hpp"
#include "host/bake_runner.hpp"
#include "scene/files.hpp"

#include <chrono>
#include <filesystem>

namespace ao::tools {
namespace {

using clock = std::chrono::steady_clock;

bake_part new_part(const bake_options& o, const bake_choice& choice, const bake_work& work)
{
    bake_part p;
    std::error_code failure;
    const auto path = std::filesystem::absolute(o.model, failure);
    p.model = failure ? o.model : path.string();
    p.choice = to_text(choice);
    p.key = key_of(work.job);
    p.vertices = work.job.vertices();
    p.lines = work.job.lines.size();
    p.shard = o.shard;
    p.shards = o.shards;
    p.wanted = shard_of(work.job, o.shard, o.shards);
    return p;
}

// What is kept of the same bake, if there is such.
void take_up(bake_part& part, const bake_options& o)
{
    std::error_code failure;
    if (!o.resume || !std::filesystem::exists(o.part, failure))
        return;
    bake_part kept;
    const std::string name = o.part.string();
    try {
        kept = part_from(read_file(name));
    } catch (const error& e) {
        const std::string why = e.what();
        throw error(why.rfind(name, 0) == 0 ? why : name + ": " + why);
    }
    if (kept.key != part.key || kept.vertices != part.vertices || kept.lines != part.lines || !(kept.wanted == part.wanted))
        throw error(name + ": kept of another bake (model, settings or shard); without --resume it is replaced");
    part.done = std::move(kept.done);
    part.seconds = kept.seconds;
}

class baking {
public:
    baking(const bake_options& options, const bake_work& w, bake_part& p)
        : o(options),
          work(w),
          part(p),
          runner(take(options.backend, host::make_bake_runner(options.backend, { o.device, o.lanes, o.threads }))),
          before(static_cast<double>(p.size_done())),
          line(before > 0
                   ? "bake, " + std::to_string(static_cast<int>(100 * before / static_cast<double>(p.wanted.size()))) + " % kept,"
                   : "bake",
               options.progress)
    {
        part.device = runner->device();
    }

    void run()
    {
        double slice = o.keep_every;
        while (!interrupted()) {
            const std::vector<bake_area> left = part.missing();
            if (left.empty())
                return;
            const std::uint64_t done = part.size_done();
            run_slice(left.front(), slice);
            if (!part.complete() && !interrupted())
                keep(o, part);
            if (part.size_done() == done) // nothing is done in so short a time
                slice = 2 * slice + 0.1;
        }
    }

    [[nodiscard]] std::string backend() const { return std::string(runner->backend()); }

private:
    void run_slice(const bake_area& a, double seconds)
    {
        const auto start = clock::now();
        const auto since = [&] { return std::chrono::duration<double>(clock::now() - start).count(); };
        const auto size = static_cast<double>(a.size());
        const auto done = static_cast<double>(part.size_done());
        const auto all = static_cast<double>(part.wanted.size());
        bake_request request{ a.first_vertex, a.last_vertex, a.first_line, a.last_line, bake_route::automatic, {} };
        request.progress = [&](double share) {
            line.update((done - before + share * size) / (all - before));
            return !interrupted() && (o.part.empty() || since() < seconds);
        };
        bake_sums sums = take(std::string(runner->backend()), runner->run(work.job, request));
        part.seconds += since();
        part.add(std::move(sums));
    }

    const bake_options& o;
    const bake_work& work;
    bake_part& part;
    host::bake_runner_ptr runner;
    double before; // done by earlier starts
    progress_line line;
};

std::string percent(const bake_part& p)
{
    return std::to_string(100 * p.size_done() / p.wanted.size()) + " %";
}

} // namespace

const char* name_of(ao::bake_route route)
{
    constexpr const char* names[] = { "auto", "brute", "tiled", "packed", "hierarchy", "raster", "embree", "cube" };
    return names[static_cast<std::size_t>(route)];
}

bool keep(const bake_options& o, const bake_part& part)
{
    if (o.part.empty() || part.size_done() == 0)
        return false;
    write_file(o.part, bytes_of(part));
    return true;
}

bake_run_facts run_work(const bake_options& o, const bake_choice& choice, const bake_work& work)
{
    bake_run_facts facts;
    bake_part part = new_part(o, choice, work);
    take_up(part, o);
    facts.kept = part.wanted.size() > 0 ? static_cast<double>(part.size_done()) / static_cast<double>(part.wanted.size()) : 0.0;
    {
        baking b(o, work, part);
        facts.backend = b.backend();
        try {
            b.run();
        } catch (const error&) {
            keep(o, part);
            throw;
        }
    }
    if (!part.complete()) {
        if (!keep(o, part))
            throw error("interrupted");
        throw error("interrupted at " + percent(part) + "; " + o.part.string() + " keeps it for --resume");
    }
    facts.device = part.device;
    facts.seconds = part.seconds;
    if (!part.done.empty()) {
        facts.route = name_of(part.done.back().route);
        facts.reason = part.done.back().reason;
    }
    facts.parts.push_back(std::move(part));
    return facts;
}

} // namespace ao::tools
