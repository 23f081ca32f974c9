// Whatever a configuration file or an assignment holds, every option keeps its kind and its limits.
#include "memory_file.h"
#include "vicon/core/error.h"
#include "vicon/core/options.h"
#include "vicon/ingest/import.h"
#include "vicon/ingest/receiver.h"

using namespace vicon;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const fuzz::MemoryFile file;
    Config config;
    config.declare(specsOf<ingest::ImportOptions>());
    config.declare(specsOf<ingest::ReceiverOptions>());
    file.fill(data, size);
    try {
        config.readFile(file.path());
    } catch (const Error& e) {
        fuzz::require(e.code() == ErrorCode::wrong_use);
    }
    try {
        config.set(std::string(reinterpret_cast<const char*>(data), size));
    } catch (const Error& e) {
        fuzz::require(e.code() == ErrorCode::wrong_use);
    }
    for (const OptionSpec& spec : config.specs()) {
        const nlohmann::json& value = config.at(spec.key).value;
        fuzz::require(value.is_string() == spec.default_value.is_string());
        if (value.is_number())
            fuzz::require(value.get<double>() >= spec.lowest && value.get<double>() <= spec.highest);
    }
    (void)config.get<ingest::ImportOptions>();
    (void)config.get<ingest::ReceiverOptions>();
    (void)config.peers().dump();
    return 0;
}
