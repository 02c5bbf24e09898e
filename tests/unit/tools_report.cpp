#include "scene/report.hpp"
#include "scene/signals.hpp"

#include "scene/error.hpp"

#include <catch2/catch.hpp>

#include <csignal>

using namespace ao::tools;

namespace {

report_data example()
{
    report_data d;
    d.title = "<b>\"scene\" & 'co'</b>";
    d.facts = { { "scene", "a<b" }, { "size", "4x3" } };
    d.runs.push_back({ "cpu", "<script>", "8 lanes", { { "occlusion", 1.5 }, { "filter", 0.25 } }, 1.75, 2.0, {} });
    d.runs.push_back({ "gl", "llvmpipe", "compute", {}, 12.0, 30.0, report_error{ 0.0763, -0.01, 0.25 } });
    d.best_constant = report_error{ 0.16, 0.0, 0.5 };
    d.scenes.push_back({ "vk", "a<b", "graphics", 7.25, "2 objects", {}, "" });
    d.agreements.push_back({ "visibility", "cpu", "gl", 12, 3, 0.5 });
    d.agreements.push_back({ "object and material", "cpu", "gl", 12, 0, {} });
    d.pictures = { { "one", "\x01\x02\x03" }, { "two & more", "abc" } };
    return d;
}

std::size_t count(const std::string& text, const std::string& what)
{
    std::size_t n = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
        ++n;
    return n;
}

} // namespace

TEST_CASE("base64 follows RFC 4648", "[tools][report]")
{
    const std::pair<const char*, const char*> vectors[] = { { "", "" },
                                                            { "f", "Zg==" },
                                                            { "fo", "Zm8=" },
                                                            { "foo", "Zm9v" },
                                                            { "foob", "Zm9vYg==" },
                                                            { "fooba", "Zm9vYmE=" },
                                                            { "foobar", "Zm9vYmFy" },
                                                            { "\xff\xfe", "//4=" } };
    for (const auto& [plain, coded] : vectors)
        CHECK(to_base64(plain) == coded);
}

TEST_CASE("the report holds every number and needs nothing else", "[tools][report]")
{
    const std::string html = make_report(example());
    CHECK(html.find("<b>") == std::string::npos);
    CHECK(html.find("&lt;b&gt;&quot;scene&quot; &amp; &#39;co&#39;&lt;/b&gt;") != std::string::npos);
    CHECK(count(html, "<script>") == 1); // its own; the device's name is text
    for (const char* cell :
         { "0.0763", "-0.0100", "0.2500", "best constant", "occlusion 1.50\nfilter 0.25", "two &amp; more", "7.25", "a&lt;b",
           "object and material", "data:image/png;base64,AQID", "data:image/png;base64,YWJj" })
        CHECK(html.find(cell) != std::string::npos);
    CHECK(html.find("http") == std::string::npos);
    CHECK(count(html, "<table") == count(html, "</table>"));
    CHECK(count(html, "<option") == 4);
    CHECK(count(html, "<tr>") == count(html, "</tr>"));
}

TEST_CASE("a report without pictures or agreement leaves them out", "[tools][report]")
{
    report_data d = example();
    d.pictures.clear();
    d.agreements.clear();
    d.scenes.clear();
    const std::string html = make_report(d);
    CHECK(html.find("<script>") == std::string::npos);
    CHECK(html.find("Agreement") == std::string::npos);
    CHECK(html.find("Drawing") == std::string::npos);
    CHECK(make_table(d).find("differing") == std::string::npos);
}

TEST_CASE("columns of the table line up", "[tools][report]")
{
    const std::string table = make_table(example());
    std::vector<std::string> lines;
    for (std::size_t from = 0, to; (to = table.find('\n', from)) != std::string::npos; from = to + 1)
        lines.push_back(table.substr(from, to - from));
    REQUIRE(lines.size() == 11);
    const std::size_t device = lines[0].find("device");
    CHECK(lines[1].substr(device, 8) == "<script>");
    CHECK(lines[2].substr(device, 8) == "llvmpipe");
    CHECK(lines[2].substr(lines[0].find("RMSE"), 6) == "0.0763");
}

TEST_CASE("progress tells the share done and the time left", "[tools][signals]")
{
    CHECK(progress_line::text("truth", 0.0, 3.0) == "truth  0 %");
    CHECK(progress_line::text("truth", 0.5, 65.0) == "truth  50 %, 1:05 left");
    CHECK(progress_line::text("truth", 0.25, 3.0) == "truth  25 %, 0:09 left");
    CHECK(progress_line::text("truth", 1.0, 3.0) == "truth  100 %, 0:00 left");
}

TEST_CASE("the first interrupt only sets the flag", "[tools][signals]")
{
    struct sigaction before_int = {}, before_term = {}, now = {};
    sigaction(SIGINT, nullptr, &before_int);
    sigaction(SIGTERM, nullptr, &before_term);
    catch_interrupts();
    CHECK_FALSE(interrupted().load());
    std::raise(SIGINT);
    CHECK(interrupted().load());
    sigaction(SIGINT, nullptr, &now);
    CHECK(now.sa_handler == SIG_DFL); // so that the second one ends the process
    sigaction(SIGINT, &before_int, nullptr);
    sigaction(SIGTERM, &before_term, nullptr);
}

TEST_CASE("a message of another library fits one line", "[tools][error]")
{
    CHECK(one_line("a\n\tb  c\r\n") == "a b c");
    CHECK(one_line("\n\n").empty());
}
