// Whatever bytes a text holds and whatever character sets it names, it becomes UTF-8 that commands nothing.
#include <unicode/unistr.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "text.h"
#include "vicon/core/printable.h"

using namespace vicon::ingest;

namespace {

const std::vector<std::vector<std::string>> kSets{{},
                                                  {""},
                                                  {"ISO_IR 100"},
                                                  {"ISO_IR 192"},
                                                  {"GB18030"},
                                                  {"GBK"},
                                                  {"", "ISO 2022 IR 87"},
                                                  {"ISO_IR 13", "ISO 2022 IR 87", "ISO 2022 IR 159"},
                                                  {"", "ISO 2022 IR 149"},
                                                  {"", "ISO 2022 IR 58"},
                                                  {"nonsense"}};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size < 1)
        return 0;
    const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
    const auto& sets = kSets[data[0] % kSets.size()];
    for (const TextKind kind : {TextKind::person_name, TextKind::single_line}) {
        const std::string text = vicon::printable(toUtf8(bytes, sets, kind));
        const auto again = icu::UnicodeString::fromUTF8(text);
        std::string same;
        again.toUTF8String(same);
        if (same != text)
            std::abort();  // is UTF-8
        for (const char c : text)
            if (std::uint8_t(c) < 0x20 || c == 0x7f)
                std::abort();
        (void)foldedForComparison(tidyPersonName(text));
    }
    return 0;
}
