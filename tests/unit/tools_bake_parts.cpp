// `ao bake` in parts: shards, bakes that are interrupted, killed or cannot be written, and processes of MPI.
#include "tools_bake_support.hpp"

#include <algorithm>
#include <utility>

TEST_CASE("shards in any number and order merge to the bits of the whole", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(6));
    const auto file = [&](const std::string& name) { return (dir.path / name).string(); };
    // By lines and, for a rule with few of them, by vertices.
    for (const char* rule : { "lebedev:590", "fibonacci:20" }) {
        INFO(rule);
        const words choice{ model, "--rule", rule, "--coefficient", "cosine", "--distance", "0.5", "--bent-normals" };
        const auto with = [&](words more) {
            more.insert(more.begin(), choice.begin(), choice.end());
            return more;
        };
        bake(dir, with({ "--out", file("whole.csv") }));
        const std::string whole = read_all(file("whole.csv"));
        for (const int n : { 1, 3, 7 }) {
            INFO(n);
            words merge{ "--merge" };
            for (int i = n; i >= 1; --i) {
                const std::string part = file("part" + std::to_string(i));
                bake(dir, with({ "--shard", std::to_string(i) + "/" + std::to_string(n), "--out", part }));
                merge.push_back(part);
            }
            merge.insert(merge.end(), { "--out", file("merged.csv") });
            bake(dir, merge);
            CHECK(read_all(file("merged.csv")) == whole);
        }
    }
    // The last bake left the seven of fibonacci:20.
    const std::string first = file("part1"), second = file("part2");
    bake(dir, { model, "--rule", "lebedev:26", "--shard", "2/2", "--out", file("foreign") });
    bake(dir, { model, "--rule", "fibonacci:20", "--coefficient", "cosine", "--distance", "0.5", "--bent-normals", "--shard",
                "1/2", "--out", file("half") });
    const std::string bytes = read_all(first);
    const std::string cut = dir.file("cut", bytes.substr(0, bytes.size() / 2));
    std::string wrong = bytes;
    wrong[bytes.size() - 20] = static_cast<char>(wrong[bytes.size() - 20] ^ 1);
    const std::string damaged = dir.file("damaged", wrong);
    const std::string other = dir.file("other.obj", sphere_on_floor(5));
    words all{ "--merge" };
    for (int i = 1; i <= 7; ++i)
        all.push_back(file("part" + std::to_string(i)));
    words all_but_one = all;
    all_but_one.erase(all_but_one.begin() + 4);
    words of_other = all;
    of_other.insert(of_other.begin(), other);
    const std::size_t count = files_in(dir.path);
    const std::pair<words, std::string> cases[] = {
        { all_but_one, "shard 4/7 is missing" },
        { { "--merge", first, second, first }, "part1: shard 1/7 is in " + first },
        { { "--merge", first, file("foreign") }, "foreign: of another bake than " + first },
        { { "--merge", first, file("half") }, "half: shard 1/2 overlaps " + first },
        { { "--merge", second, cut }, "cut: cut short or damaged" },
        { { "--merge", second, damaged }, "damaged: cut short or damaged" },
        { of_other, "other.obj: not the model" },
    };
    for (auto [arguments, reason] : cases) {
        arguments.insert(arguments.begin(), "bake");
        arguments.insert(arguments.end(), { "--out", file("never.csv") });
        check_failure(dir, arguments, reason);
    }
    CHECK(files_in(dir.path) == count);
}

TEST_CASE("an interrupted bake goes on where it was, to the same bits", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(24));
    const auto file = [&](const std::string& name) { return (dir.path / name).string(); };
    const words slow{ "bake",      model, "--rule", "fibonacci-pairs:6000", "--route", "brute", "--lanes", "scalar",
                      "--threads", "1",   "--out",  file("o.npy") };
    words whole{ model, "--rule", "fibonacci-pairs:6000", "--out", file("whole.npy") };
    bake(dir, whole);
    int interrupts = 0;
    words again = slow;
    for (; interrupts < 3; ++interrupts) {
        const int status = run(dir, again, 700);
        if (status == 0)
            break;
        CHECK(status == 1);
        const std::string said = read_all(dir.path / "err");
        INFO(said);
        REQUIRE(said.rfind("ao: interrupted", 0) == 0);
        CHECK_FALSE(std::filesystem::exists(file("o.npy")));
        again = slow;
        again.emplace_back("--resume");
    }
    CHECK(interrupts > 0);
    REQUIRE(std::filesystem::exists(file("o.npy.part")));
    // Of another bake: refused, and kept as it is.
    const std::string kept = read_all(file("o.npy.part"));
    check_failure(dir, { "bake", model, "--rule", "lebedev:26", "--out", file("o.npy"), "--resume" }, "another bake");
    CHECK(read_all(file("o.npy.part")) == kept);
    // By another route and width: the bits are the same.
    bake(dir, { model, "--rule", "fibonacci-pairs:6000", "--out", file("o.npy"), "--resume", "--json", file("o.json") });
    CHECK(read_all(file("o.npy")) == read_all(file("whole.npy")));
    CHECK(json::parse(read_all(file("o.json")))["kept_share"].get<double>() > 0.0);
    CHECK_FALSE(std::filesystem::exists(file("o.npy.part")));
}

TEST_CASE("a killed bake loses what it did since it was last kept, and no more", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(24));
    const auto file = [&](const std::string& name) { return (dir.path / name).string(); };
    bake(dir, { model, "--rule", "fibonacci-pairs:6000", "--out", file("whole.npy") });
    const pid_t child = ::fork();
    REQUIRE(child >= 0);
    if (child == 0) {
        const std::string out = file("o.npy");
        ::execl(AO_PROGRAM, AO_PROGRAM, "bake", model.c_str(), "--rule", "fibonacci-pairs:6000", "--route", "brute", "--lanes",
                "scalar", "--threads", "1", "--out", out.c_str(), "--keep-every", "0", static_cast<char*>(nullptr));
        _exit(127);
    }
    for (int i = 0; i < 3000 && !std::filesystem::exists(file("o.npy.part")); ++i)
        ::usleep(10'000);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));
    REQUIRE(std::filesystem::exists(file("o.npy.part")));
    bake(dir, { model, "--rule", "fibonacci-pairs:6000", "--out", file("o.npy"), "--resume", "--json", file("o.json") });
    CHECK(read_all(file("o.npy")) == read_all(file("whole.npy")));
    CHECK(json::parse(read_all(file("o.json")))["kept_share"].get<double>() > 0.0);
}

TEST_CASE("a bake whose results cannot be written is kept", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(6));
    const std::string part = (dir.path / "kept").string(), out = (dir.path / "o.csv").string();
    check_failure(dir, { "bake", model, "--rule", "lebedev:26", "--json", "/dev/full", "--part", part },
                  "No space left on device; " + part + " keeps the bake");
    bake(dir,
         { model, "--rule", "lebedev:26", "--part", part, "--resume", "--out", out, "--json", (dir.path / "o.json").string() });
    CHECK(json::parse(read_all(dir.path / "o.json"))["kept_share"] == 1.0);
    CHECK_FALSE(std::filesystem::exists(part));
}

#ifdef AO_MPIRUN
TEST_CASE("mpirun spreads a bake over its processes, to the same bits", "[tools][bake]")
{
    const scratch_directory dir;
    const std::string model = dir.file("ball.obj", sphere_on_floor(6));
    const auto file = [&](const char* name) { return (dir.path / name).string(); };
    const auto with_three = [&](const std::string& arguments) {
        const std::string command = std::string(AO_MPIRUN) + " --allow-run-as-root --oversubscribe -n 3 " + AO_PROGRAM +
                                    " bake " + arguments + " >" + file("out") + " 2>" + file("err");
        return std::system(command.c_str());
    };
    bake(dir, { model, "--rule", "lebedev:590", "--out", file("whole.csv") });
    REQUIRE(with_three(model + " --rule lebedev:590 --out " + file("spread.csv")) == 0);
    CHECK(read_all(file("spread.csv")) == read_all(file("whole.csv")));
    const std::size_t count = files_in(dir.path);
    CHECK(with_three(model + " --rule lebedev:591 --out " + file("never.csv")) != 0);
    const std::string said = read_all(file("err"));
    const std::size_t at = said.find("ao: ");
    REQUIRE(at != std::string::npos);
    CHECK(said.find("ao: ", at + 1) == std::string::npos);
    CHECK(files_in(dir.path) == count);
}
#endif
