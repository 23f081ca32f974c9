#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "vicon/core/option_names.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vicon::app {

/// What an option's value is held against before the command runs.
struct ValueCheck {
    enum class Kind { integers, numbers, existing_path };
    Kind kind = Kind::integers;
    double least = 0, most = 0;
};
ValueCheck range(int least, int most);
ValueCheck range(double least, double most);
ValueCheck existingPath();

/// One option of a subcommand; each call says one thing more of it.
class CommandOption {
public:
    explicit CommandOption(CLI::Option& option) : option_(&option) {}

    CommandOption& required();
    CommandOption& typeName(const std::string& name);
    CommandOption& check(const ValueCheck& check);
    /// Says the value that it has now as the default.
    CommandOption& captureDefault();
    CommandOption& needs(const CommandOption& other);
    CommandOption& excludes(const CommandOption& other);
    /// Given without a value it means `value`.
    CommandOption& valueIfBare(const std::string& value);
    /// So many values at once.
    CommandOption& values(int count);
    /// One value each time it is given.
    CommandOption& oneValueEach();
    /// Words, which may be taken away; an empty name is refused, as that of a variable that is not set.
    CommandOption& mayBeEmpty();
    /// Whether it was given; known once the command line is read.
    bool given() const;

private:
    CLI::Option* option_;
};

/// The command line of one subcommand: where it declares its options. CLI11, of which only command_line.cpp and
/// main.cpp know, takes seconds to compile.
class CommandLine {
public:
    explicit CommandLine(CLI::App& app) : app_(&app) {}

    /// @param name "NAME" of a positional argument or "--name"
    /// @tparam Value instantiated in command_line.cpp: text, numbers, paths, lists of text
    template <class Value>
    CommandOption option(const std::string& name, Value& value, const std::string& help);
    /// One of the names of an enumeration.
    template <OptionEnum Enum>
    CommandOption option(const std::string& name, Enum& value, const std::string& help)
    {
        return choice(
            name, namesOf(optionNames(value)),
            [name, &value](const std::string& said) { value = valueIn(optionNames(value), said, name); }, help,
            nameIn(optionNames(value), value));
    }
    /// The same; nothing as long as none is given.
    template <OptionEnum Enum>
    CommandOption option(const std::string& name, std::optional<Enum>& value, const std::string& help)
    {
        return choice(
            name, namesOf(optionNames(Enum{})),
            [name, &value](const std::string& said) { value = valueIn(optionNames(Enum{}), said, name); }, help, "");
    }
    /// @param name "--name"; "!--no-name" sets it to false; several separated by commas
    CommandOption flag(const std::string& name, bool& value, const std::string& help);

private:
    CommandOption choice(const std::string& name, const std::vector<std::string>& words,
                         const std::function<void(const std::string&)>& take, const std::string& help,
                         const std::string& usual);

    CLI::App* app_;
};

}  // namespace vicon::app
