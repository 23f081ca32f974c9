#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

namespace vicon::ingest {

/// What goes one way over an association, by its PDUs (PS3.8, 9.3), as it comes.
class PduStream {
public:
    /// A piece of a message.
    struct Fragment {
        std::uint8_t context = 0;
        bool is_command = false, is_last = false;
    };
    class Hearer {
    public:
        virtual ~Hearer() = default;
        /// What an A-ASSOCIATE-AC holds behind its length.
        virtual void hearAcceptance(const std::string& content) = 0;
        virtual void hearBytes(const Fragment& fragment, std::span<const unsigned char> bytes) = 0;
        virtual void hearEnd(const Fragment& fragment) = 0;
    };
    explicit PduStream(Hearer& hearer) : hearer_(hearer) {}

    /// False where a fragment does not fit into its PDU: nothing more may be added.
    bool add(std::span<const unsigned char> bytes);

private:
    enum class Part { head, fragment_head, fragment, acceptance, other };
    void takeHead();
    bool takeFragmentHead();
    void takeContent(std::span<const unsigned char> bytes);
    void goOn();

    Hearer& hearer_;
    Part part_ = Part::head;
    std::array<unsigned char, 6> head_{};  ///< of a PDU, or of a fragment
    std::size_t head_size_ = 0;
    std::uint64_t left_ = 0;           ///< bytes of the PDU
    std::uint64_t fragment_left_ = 0;  ///< bytes of the fragment
    Fragment fragment_;
    std::string acceptance_;
};

}  // namespace vicon::ingest
