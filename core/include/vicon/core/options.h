#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace vicon {

/// One option as the help, the configuration file and the documentation show it.
struct OptionSpec {
    std::string key;                   ///< "room.name", as in the configuration file: table, then name
    nlohmann::json default_value;      ///< its type is the option's: boolean, integer, number, string; array: points
    std::string unit;                  ///< "mm", "HU", "degrees", "s"; empty where there is none
    std::string help;                  ///< one sentence
    double lowest = -1e300;            ///< of numbers
    double highest = 1e300;            ///< of numbers
    std::vector<std::string> choices;  ///< of strings; empty: any
};

/// What a field() call may add to an option.
struct OptionLimits {
    double lowest = -1e300;
    double highest = 1e300;
    std::vector<std::string> choices = {};
};

/// A struct of options declares its fields once, with the default in the struct itself:
///
///     struct SegmentOptions {
///         double gas_below_hu = -800;
///         template <class Visitor> void visit(Visitor&& v) {
///             v("segment.gas_below_hu", gas_below_hu, "HU", "Voxels below this density may be gas.", {-1000, -200});
///         }
///     };
///
/// specsOf(), Config::get() and toJson() then serve help, file, command line and the record of a step.
template <class Options>
std::vector<OptionSpec> specsOf()
{
    std::vector<OptionSpec> specs;
    Options{}.visit(
        [&](const char* key, auto& value, const char* unit, const char* help, const OptionLimits& limits = {}) {
            specs.push_back({key, value, unit, help, limits.lowest, limits.highest, limits.choices});
        });
    return specs;
}

template <class Options>
nlohmann::json toJson(Options options)
{
    nlohmann::json out = nlohmann::json::object();
    options.visit(
        [&](const char* key, auto& value, const char*, const char*, const OptionLimits& = {}) { out[key] = value; });
    return out;
}

/// The effective configuration: built-in defaults, then the file, then `--set key=value`.
class Config {
public:
    struct Value {
        nlohmann::json value;
        std::string source;  ///< "default", the file's path, or "command line"
    };

    /// Makes keys known; an unknown key in a file or on the command line is an error.
    void declare(const std::vector<OptionSpec>& specs);
    /// Reads a TOML file. Throws Error{wrong_use} naming file, line and key of what is wrong in it.
    void readFile(const std::filesystem::path& file);
    /// Takes one "key=value" of the command line. Throws Error{wrong_use}.
    void set(const std::string& assignment);

    const std::vector<OptionSpec>& specs() const { return specs_; }
    const Value& at(const std::string& key) const;
    /// Peers as the file gives them: name to {host, port, ae_title}; an empty object when there are none.
    const nlohmann::json& peers() const { return peers_; }

    /// An options struct with the effective values.
    template <class Options>
    Options get() const
    {
        Options options;
        options.visit([&](const char* key, auto& value, const char*, const char*, const OptionLimits& = {}) {
            if (const auto found = values_.find(key); found != values_.end())
                found->second.value.get_to(value);
        });
        return options;
    }

private:
    void assign(const std::string& key, nlohmann::json value, const std::string& source);
    const OptionSpec& specFor(const std::string& key, const std::string& source) const;

    std::vector<OptionSpec> specs_;
    std::map<std::string, Value> values_;
    nlohmann::json peers_ = nlohmann::json::object();
};

}  // namespace vicon
