#include "files.hpp"

#include "error.hpp"

#include <cerrno>
#include <fcntl.h>
#include <string>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

#include <utility>

namespace ao::tools {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& path, int code)
{
    throw error(path.string() + ": cannot write: " + std::generic_category().message(code));
}

class descriptor {
public:
    explicit descriptor(int d) : number(d) {}
    descriptor(const descriptor&) = delete;
    descriptor& operator=(const descriptor&) = delete;
    ~descriptor()
    {
        if (number >= 0)
            ::close(number);
    }
    [[nodiscard]] int get() const { return number; }

    // Some file systems tell only here that the disk is full.
    [[nodiscard]] int close() { return ::close(std::exchange(number, -1)) == 0 ? 0 : errno; }

private:
    int number;
};

// 0 or errno.
int write_all(int file, std::string_view bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return errno;
        if (written == 0)
            return EIO;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

void write_in_place(const fs::path& path, std::string_view bytes)
{
    descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0)
        fail(path, errno);
    int code = write_all(file.get(), bytes);
    if (code == 0)
        code = file.close();
    if (code != 0)
        fail(path, code);
}

// O_EXCL with a name of our own instead of mkstemp, whose mode 0600 ignores the umask.
fs::path temporary_beside(const fs::path& target)
{
    std::string name(1, '.');
    name += target.filename().string() + '.' + std::to_string(::getpid()) + ".tmp";
    return target.parent_path() / name;
}

} // namespace

void write_file(const fs::path& path, std::string_view bytes)
{
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::directory)
        fail(path, EISDIR);
    if (fs::exists(status) && !fs::is_regular_file(status))
        return write_in_place(path, bytes);

    const fs::path resolved = fs::weakly_canonical(path, failure);
    const fs::path target = failure ? path : resolved;
    if (target.filename().empty())
        fail(path, EISDIR);
    const fs::path temporary = temporary_beside(target);
    descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.get() < 0)
        fail(path, errno);

    int code = write_all(file.get(), bytes);
    if (code == 0 && ::fsync(file.get()) != 0)
        code = errno;
    if (const int closing = file.close(); code == 0)
        code = closing;
    if (code == 0 && ::rename(temporary.c_str(), target.c_str()) != 0)
        code = errno;
    if (code != 0) {
        ::unlink(temporary.c_str());
        fail(path, code);
    }
}

void check_writable(const fs::path& path)
{
    std::error_code failure;
    const fs::file_status status = fs::status(path, failure);
    if (status.type() == fs::file_type::directory)
        fail(path, EISDIR);
    const bool in_place = fs::exists(status) && !fs::is_regular_file(status);
    const fs::path needed = in_place ? path : fs::absolute(path).parent_path();
    if (::access(needed.c_str(), in_place ? W_OK : W_OK | X_OK) != 0)
        fail(path, errno);
    if (!in_place && !fs::is_directory(needed, failure))
        fail(path, ENOTDIR);
}

void make_directory(const fs::path& path)
{
    std::error_code failure;
    fs::create_directories(path, failure);
    if (failure)
        throw error(path.string() + ": cannot make the directory: " + failure.message());
    if (!fs::is_directory(path, failure))
        throw error(path.string() + ": not a directory");
    if (::access(path.c_str(), W_OK | X_OK) != 0)
        fail(path, errno);
}

} // namespace ao::tools
