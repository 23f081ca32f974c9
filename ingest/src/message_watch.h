#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "element_stream.h"
#include "pdu_stream.h"

namespace vicon::ingest {

/// Looks at what a peer sends over an association before DCMTK does, which takes commands and the data sets of messages
/// into memory with one call of a function for each level of their nesting. Commands have at most kMostCommandBytes,
/// data sets kMostMessageBytes, both the limits of files. The data sets of C-STORE go into files as they are, and are
/// looked at there. For the thread of the association alone.
class MessageWatch : private PduStream::Hearer {
public:
    MessageWatch() : sent_(*this), received_(*this) {}
    MessageWatch(const MessageWatch&) = delete;
    MessageWatch& operator=(const MessageWatch&) = delete;

    /// What goes to the peer, for what is agreed with it.
    void send(std::span<const unsigned char> bytes);
    /// What comes from the peer. False where DCMTK must not see it.
    bool receive(std::span<const unsigned char> bytes);
    /// Why it must not; empty: it may see all that came so far.
    const std::string& whyEnded() const { return why_ended_; }

private:
    void hearAcceptance(const std::string& content) override;
    void hearBytes(const PduStream::Fragment& fragment, std::span<const unsigned char> bytes) override;
    void hearEnd(const PduStream::Fragment& fragment) override;
    void beginCommand();
    void endCommand();
    void beginDataset(std::uint8_t context);
    void refuse(const std::string& why);

    PduStream sent_, received_;
    bool sending_ = false;
    std::map<std::uint8_t, std::string> syntaxes_;  ///< by context, as agreed
    std::string command_;
    bool in_command_ = false, storing_ = false;
    std::optional<ElementStream> elements_;  ///< of what is being received, where it is looked at
    std::string why_ended_;
};

/// Those in use, of one class and one instance, have some hundred.
inline constexpr std::size_t kMostCommandBytes = 4096;
/// A request for commitment of 10,000 objects has 2 MB.
inline constexpr std::size_t kMostMessageBytes = 16U << 20U;

}  // namespace vicon::ingest
