#include "command_line.h"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <type_traits>

namespace fs = std::filesystem;

namespace vicon::app {
namespace {

/// Only what is surely not there is a slip of the pen; what may not be looked at is the command's to tell.
std::string whyNoPath(const std::string& path)
{
    std::error_code failure;
    const bool missing = fs::status(path, failure).type() == fs::file_type::not_found;
    return missing ? "no such file or folder: " + path : "";
}

constexpr const char* kFilled = "filled";

std::string whyEmpty(const std::string& text)
{
    return text.empty() ? "is empty; give a value, or leave it out" : "";
}

std::string whyNotFinite(const std::string& text)
{
    double value = 0;
    return !CLI::detail::lexical_cast(text, value) || std::isfinite(value) ? "" : "is no finite number: " + text;
}

}  // namespace

ValueCheck range(int least, int most)
{
    return {.kind = ValueCheck::Kind::integers, .least = double(least), .most = double(most)};
}

ValueCheck range(double least, double most)
{
    return {.kind = ValueCheck::Kind::numbers, .least = least, .most = most};
}

ValueCheck existingPath()
{
    return {.kind = ValueCheck::Kind::existing_path};
}

CommandOption& CommandOption::required()
{
    option_->required();
    return *this;
}

CommandOption& CommandOption::typeName(const std::string& name)
{
    option_->type_name(name);
    return *this;
}

CommandOption& CommandOption::check(const ValueCheck& check)
{
    switch (check.kind) {
        case ValueCheck::Kind::integers:
            option_->check(CLI::Range(int(check.least), int(check.most)));
            break;
        case ValueCheck::Kind::numbers:
            option_->check(CLI::Range(check.least, check.most));
            break;
        case ValueCheck::Kind::existing_path:
            option_->check(CLI::Validator(whyNoPath, ""));
            break;
    }
    return *this;
}

CommandOption& CommandOption::captureDefault()
{
    option_->capture_default_str();
    return *this;
}

CommandOption& CommandOption::needs(const CommandOption& other)
{
    option_->needs(other.option_);
    return *this;
}

CommandOption& CommandOption::excludes(const CommandOption& other)
{
    option_->excludes(other.option_);
    return *this;
}

CommandOption& CommandOption::valueIfBare(const std::string& value)
{
    option_->expected(0, 1)->default_str(value);
    return *this;
}

CommandOption& CommandOption::values(int count)
{
    option_->expected(count);
    return *this;
}

CommandOption& CommandOption::oneValueEach()
{
    option_->allow_extra_args(false);
    return *this;
}

CommandOption& CommandOption::mayBeEmpty()
{
    option_->get_validator(kFilled)->active(false);
    return *this;
}

bool CommandOption::given() const
{
    return option_->count() > 0;
}

template <class Value>
CommandOption CommandLine::option(const std::string& name, Value& value, const std::string& help)
{
    CLI::Option* const option = app_->add_option(name, value, help);
    if constexpr (std::is_same_v<Value, double>)
        option->check(CLI::Validator(whyNotFinite, ""));
    else if constexpr (!std::is_arithmetic_v<Value>)
        option->check(CLI::Validator(whyEmpty, "", kFilled));
    return CommandOption(*option);
}

template CommandOption CommandLine::option(const std::string&, std::string&, const std::string&);
template CommandOption CommandLine::option(const std::string&, int&, const std::string&);
template CommandOption CommandLine::option(const std::string&, double&, const std::string&);
template CommandOption CommandLine::option(const std::string&, std::uint64_t&, const std::string&);
template CommandOption CommandLine::option(const std::string&, std::vector<std::string>&, const std::string&);

CommandOption CommandLine::choice(const std::string& name, const std::vector<std::string>& words,
                                  const std::function<void(const std::string&)>& take, const std::string& help,
                                  const std::string& usual)
{
    CLI::Option* const option = app_->add_option_function<std::string>(name, take, help);
    option->check(CLI::IsMember(words))->default_function([usual] { return usual; });
    return CommandOption(*option);
}

CommandOption CommandLine::flag(const std::string& name, bool& value, const std::string& help)
{
    return CommandOption(*app_->add_flag(name, value, help));
}

}  // namespace vicon::app
