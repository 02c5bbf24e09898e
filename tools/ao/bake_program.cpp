#include "ao/bake_program.hpp"

#include "ao/bake_results.hpp"
#include "ao/bake_work.hpp"
#include "ao/outcome.hpp"
#include "ao/processes.hpp"
#include "scene/files.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>

namespace ao::tools {
namespace {

std::vector<bake_part> read_parts(const std::vector<std::string>& files)
{
    std::vector<bake_part> parts;
    for (const std::string& file : files) {
        const std::string bytes = read_file(file);
        try {
            parts.push_back(part_from(bytes));
        } catch (const error& e) {
            throw error(file + ": " + e.what());
        }
    }
    check_together(parts, files);
    return parts;
}

void check_outputs(const bake_options& o)
{
    for (const std::string& file : o.out)
        check_writable(file);
    for (const std::filesystem::path& file : { std::filesystem::path(o.picture), o.json, o.part })
        if (!file.empty())
            check_writable(file);
}

class stopwatch {
public:
    double operator()() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); }

private:
    std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

void print(const std::string& text)
{
    std::fputs(text.c_str(), stdout);
    if (std::fflush(stdout) != 0)
        throw error("cannot write to the standard output");
}

// What is done is in the part's file until all is written.
void write_all(const bake_options& o, const bake_choice& c, const bake_work& work, const bake_run_facts& facts, double seconds)
{
    std::optional<bake_results> results;
    if (o.sharded) {
        write_file(o.out[0], bytes_of(facts.parts[0]));
    }
    else {
        results = finish_work(o, work, facts.parts);
        write_results(o, work, *results);
    }
    if (!o.json.empty())
        write_file(o.json, json_of(o, c, work, facts, results ? &*results : nullptr, seconds));
    print(summary_of(work, facts, results ? &*results : nullptr));
}

void merge(const bake_options& o, const stopwatch& seconds)
{
    bake_run_facts facts;
    facts.parts = read_parts(o.merge);
    const bake_choice choice = choice_from(facts.parts[0].choice);
    const std::string model = o.model.empty() ? facts.parts[0].model : o.model;
    const bake_work work = prepare_work(model, choice, route_of(choice));
    if (key_of(work.job) != facts.parts[0].key)
        throw error(model + ": not the model of which " + o.merge[0] + " is a part");
    for (const bake_part& p : facts.parts)
        facts.seconds += p.seconds;
    facts.reason = "merged";
    write_all(o, choice, work, facts, seconds());
}

// For an error that comes when the share of this process is done: keeps that, and says where.
std::string kept_after(const bake_options& o, const bake_part& part, const std::string& reason)
{
    bool kept = false;
    try {
        kept = keep(o, part);
    } catch (const error&) {
        // The disk may be full of the results; why they failed is what matters.
    }
    return kept ? std::string(reason).append("; ").append(o.part.string()).append(" keeps the bake for --resume") : reason;
}

// What the process of rank i does.
bake_options share_of(bake_options o, const processes& all)
{
    if (all.size() == 1)
        return o;
    if (o.sharded)
        throw error("--shard: mpirun spreads the bake over its processes itself");
    o.shard = all.rank() + 1;
    o.shards = all.size();
    o.progress = o.progress && all.rank() == 0;
    if (!o.part.empty())
        o.part += std::string(".").append(std::to_string(o.shard)).append("of").append(std::to_string(o.shards));
    return o;
}

struct share {
    bake_choice choice;
    bake_work work;
    bake_run_facts facts;
};

std::optional<share> bake_share(const bake_options& o, std::string& problem)
{
    try {
        check_outputs(o);
        share s;
        s.choice = with_rule(o.choice);
        s.work = prepare_work(o.model, s.choice, o.route);
        s.facts = run_work(o, s.choice, s.work);
        return s;
    } catch (const std::bad_alloc&) {
        problem = "out of memory";
    } catch (const error& e) {
        problem = e.what();
    }
    return std::nullopt;
}

// Everybody's parts; in the other processes nothing.
std::vector<bake_part> parts_of_all(const processes& all, const bake_part& mine)
{
    if (all.size() == 1)
        return { mine };
    std::vector<bake_part> parts;
    for (const std::string& bytes : all.gather(bytes_of(mine)))
        parts.push_back(part_from(bytes));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < parts.size(); ++i)
        names.push_back(std::string("process ").append(std::to_string(i)));
    if (!parts.empty())
        check_together(parts, names);
    return parts;
}

} // namespace

bool bake(const bake_options& wanted)
{
    const stopwatch seconds;
    const processes all;
    if (!wanted.merge.empty()) {
        if (all.size() > 1)
            throw error("--merge: one process merges; mpirun is for baking");
        check_outputs(wanted);
        merge(wanted, seconds);
        return true;
    }
    const bake_options o = share_of(wanted, all);
    std::string problem;
    std::optional<share> mine = bake_share(o, problem);
    if (!all.all(problem.empty())) {
        // The first that knows of one tells it.
        if (mine)
            (void)kept_after(o, mine->facts.parts[0], problem);
        for (const std::string& each : all.gather(problem))
            if (!each.empty())
                throw error(each);
        return false;
    }
    const bake_part own = mine->facts.parts[0];
    try {
        mine->facts.parts = parts_of_all(all, own);
        for (std::size_t i = 1; i < mine->facts.parts.size(); ++i)
            mine->facts.seconds = std::max(mine->facts.seconds, mine->facts.parts[i].seconds);
        if (all.rank() == 0)
            write_all(o, mine->choice, mine->work, mine->facts, seconds());
    } catch (const error& e) {
        problem = kept_after(o, own, e.what());
    }
    if (!all.all(problem.empty())) {
        if (problem.empty())
            (void)kept_after(o, own, problem);
        else
            throw error(problem);
        return false;
    }
    std::error_code failure;
    if (!o.part.empty())
        std::filesystem::remove(o.part, failure);
    return true;
}

} // namespace ao::tools
