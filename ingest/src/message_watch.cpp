#include "message_watch.h"

namespace vicon::ingest {
namespace {

constexpr std::size_t kAgreedHead = 4;
constexpr Coding kCommandCoding{false, false};

const unsigned char* bytesOf(const std::string& text)
{
    return reinterpret_cast<const unsigned char*>(text.data());
}

/// Calls `use(kind, content)` for each item of an A-ASSOCIATE PDU, or of one of its items.
template <class Use>
void forEachAgreed(const std::string& content, std::size_t from, const Use& use)
{
    while (from + kAgreedHead <= content.size()) {
        const std::size_t length = numberIn(bytesOf(content) + from + 2, 2, true);
        if (length > content.size() - from - kAgreedHead)
            return;
        use(static_cast<unsigned char>(content[from]), content.substr(from + kAgreedHead, length));
        from += kAgreedHead + length;
    }
}

/// The numbers that a whole command gives for one of its elements; their order does not matter.
std::optional<std::uint32_t> oneNumberIn(const std::string& command, std::uint32_t tag)
{
    constexpr std::size_t kHead = 8;
    std::optional<std::uint32_t> found;
    for (std::size_t at = 0; at + kHead <= command.size();) {
        const unsigned char* const head = bytesOf(command) + at;
        const std::size_t length = numberIn(head + 4, 4, false);
        if (length > command.size() - at - kHead)  // none, or nested
            return {};
        if (tagIn(head, false) == tag) {
            if (found || length != 2)
                return {};
            found = numberIn(head + kHead, 2, false);
        }
        at += kHead + length;
    }
    return found;
}

}  // namespace

void MessageWatch::send(std::span<const unsigned char> bytes)
{
    sending_ = true;
    sent_.add(bytes);
    sending_ = false;
}

bool MessageWatch::receive(std::span<const unsigned char> bytes)
{
    if (why_ended_.empty() && !received_.add(bytes))
        refuse("a fragment does not fit into its PDU");
    return why_ended_.empty();
}

void MessageWatch::refuse(const std::string& why)
{
    if (why_ended_.empty())
        why_ended_ = why;
}

void MessageWatch::hearAcceptance(const std::string& content)
{
    constexpr std::size_t kFixedBytes = 68;
    constexpr unsigned char kContext = 0x21, kSyntax = 0x40;
    if (!syntaxes_.empty())  // an association is agreed once
        return;
    forEachAgreed(content, kFixedBytes, [&](unsigned char kind, const std::string& context) {
        if (kind != kContext || context.size() < kAgreedHead || context[2] != 0)
            return;
        forEachAgreed(context, kAgreedHead, [&](unsigned char what, std::string syntax) {
            syntax.erase(syntax.find_last_not_of(std::string_view(" \0", 2)) + 1);
            if (what == kSyntax)
                syntaxes_[std::uint8_t(context[0])] = syntax;
        });
    });
}

void MessageWatch::hearBytes(const PduStream::Fragment& fragment, std::span<const unsigned char> bytes)
{
    if (sending_ || !why_ended_.empty())
        return;
    if (fragment.is_command && !in_command_)
        beginCommand();
    else if (!fragment.is_command && !storing_ && !elements_)
        beginDataset(fragment.context);
    if (fragment.is_command) {
        if (command_.size() + bytes.size() > kMostCommandBytes)
            return refuse("a command has more than " + std::to_string(kMostCommandBytes) + " bytes");
        command_.append(bytes.begin(), bytes.end());
    }
    if (elements_)
        if (const std::string why = elements_->add(bytes); !why.empty())
            refuse((fragment.is_command ? "a command cannot be read: " : "the data set of a message cannot be read: ") +
                   why);
}

void MessageWatch::hearEnd(const PduStream::Fragment& fragment)
{
    if (sending_ || !fragment.is_last || !why_ended_.empty())
        return;
    if (fragment.is_command)
        endCommand();
    else
        storing_ = false;
    elements_.reset();
}

void MessageWatch::beginCommand()
{
    in_command_ = true;
    storing_ = false;
    command_.clear();
    elements_.emplace(kCommandCoding, kMostCommandBytes);
}

void MessageWatch::endCommand()
{
    constexpr std::uint32_t kField = 0x00000100, kStore = 0x0001;
    in_command_ = false;
    storing_ = oneNumberIn(command_, kField) == kStore;
}

void MessageWatch::beginDataset(std::uint8_t context)
{
    const auto syntax = syntaxes_.find(context);
    if (syntax == syntaxes_.end())
        return refuse("a message comes in a context that was not agreed");
    if (isDeflated(syntax->second))  // grows when it is read
        return refuse("the data set of a message is deflated");
    const auto coding = codingOf(syntax->second);
    if (!coding)
        return refuse("the data set of a message is in no known transfer syntax");
    elements_.emplace(*coding, kMostMessageBytes);
}

}  // namespace vicon::ingest
