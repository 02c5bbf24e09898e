#include "apart.hpp"

#include "error.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <exception>
#include <string_view>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace ao::tools {
namespace {

bool send(int pipe, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t sent = ::write(pipe, bytes.data(), bytes.size());
        if (sent < 0 && errno == EINTR)
            continue;
        if (sent <= 0)
            return false;
        bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
}

std::string receive(int pipe)
{
    std::string bytes;
    std::array<char, 1 << 16> block;
    for (;;) {
        const ssize_t got = ::read(pipe, block.data(), block.size());
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return bytes;
        bytes.append(block.data(), static_cast<std::size_t>(got));
    }
}

// The first byte says which: the result, or a message of `error`.
[[noreturn]] void child(int pipe, unsigned seconds, const std::function<std::string()>& work)
{
    for (const int signal : { SIGINT, SIGTERM, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT })
        std::signal(signal, SIG_DFL);
    const struct rlimit cpu = { seconds, seconds + 1 };
    setrlimit(RLIMIT_CPU, &cpu);
    const struct rlimit no_core = { 0, 0 };
    setrlimit(RLIMIT_CORE, &no_core);
    std::string answer;
    try {
        answer.assign(1, '=');
        answer += work();
    } catch (const std::exception& e) {
        answer.assign(1, '!');
        answer += e.what();
    }
    _exit(send(pipe, answer) ? 0 : 1);
}

} // namespace

std::string run_apart(const std::string& what, unsigned seconds, const std::function<std::string()>& work)
{
    int ends[2];
    if (::pipe(ends) != 0)
        throw error(what + ": " + std::generic_category().message(errno));
    const pid_t process = ::fork();
    if (process == 0) {
        ::close(ends[0]);
        child(ends[1], seconds, work);
    }
    const int failure = errno;
    ::close(ends[1]);
    const std::string answer = process > 0 ? receive(ends[0]) : std::string();
    ::close(ends[0]);
    if (process < 0)
        throw error(what + ": " + std::generic_category().message(failure));

    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) {}
    if (WIFSIGNALED(status)) {
        const int signal = WTERMSIG(status);
        if (signal == SIGXCPU || signal == SIGKILL)
            throw error(what + ": gave up after " + std::to_string(seconds) + " s");
        if (signal == SIGINT || signal == SIGTERM)
            throw error("interrupted");
        throw error(what + ": the reader crashed (signal " + std::to_string(signal) + ")");
    }
    if (WEXITSTATUS(status) != 0 || answer.empty())
        throw error(what + ": the reader ended without an answer");
    if (answer.front() == '!')
        throw error(answer.substr(1));
    return answer.substr(1);
}

} // namespace ao::tools
