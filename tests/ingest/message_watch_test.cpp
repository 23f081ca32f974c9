// What a peer may send in a message, looked at before a DICOM library sees it.
#include "message_watch.h"

#include <dcmtk/config/osconfig.h>

#include <dcmtk/dcmdata/dcostrmb.h>
#include <gmock/gmock.h>

#include "commitment_dataset.h"
#include "vicon/dicom/dicom_setup.h"
#include "wire.h"

namespace vicon::ingest {
namespace {

using namespace test::wire;
using testing::HasSubstr;

std::span<const unsigned char> bytesIn(const std::string& text)
{
    return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

/// Why a peer that says this over an accepted association is not heard further, as a whole and byte by byte.
std::string whyEnded(const std::string& syntax, const std::string& said)
{
    MessageWatch whole, slow;
    for (MessageWatch* watch : {&whole, &slow})
        watch->send(bytesIn(acceptance(syntax)));
    const bool heard = whole.receive(bytesIn(said));
    EXPECT_EQ(heard, whole.whyEnded().empty());
    for (const char byte : said)
        if (!slow.receive(bytesIn(std::string(1, byte))))
            break;
    EXPECT_EQ(whole.whyEnded(), slow.whyEnded());
    return whole.whyEnded();
}

std::string asking(const std::string& dataset)
{
    return fragment(true, commitmentCommand()) + fragments(false, dataset);
}

/// An explicit element of a type whose length has two bytes.
std::string element(int number, const std::string& vr, const std::string& value)
{
    return tag(8, number) + vr + littleEndian(value.size(), 2) + value;
}

std::string requestIn(E_TransferSyntax syntax, E_EncodingType encoding)
{
    std::vector<ObjectName> objects;
    for (int n = 0; n < 10'000; ++n)
        objects.push_back({UID_CTImageStorage, "1.2.826.0.1.3680043.10.9." + std::to_string(n)});
    DcmDataset dataset;
    fillRequest(dataset, "1.2.3", objects);
    std::string out(4U << 20U, '\0');
    DcmOutputBufferStream to(out.data(), offile_off_t(out.size()));
    dataset.transferInit();
    EXPECT_TRUE(dataset.write(to, syntax, encoding, nullptr).good());
    dataset.transferEnd();
    void* begin = nullptr;
    offile_off_t size = 0;
    to.flushBuffer(begin, size);
    out.resize(std::size_t(size));
    return out;
}

TEST(MessageWatch, LetsARequestForTenThousandObjectsPassInEveryEncoding)
{
    setUpDicom();
    for (const E_EncodingType encoding : {EET_ExplicitLength, EET_UndefinedLength}) {
        EXPECT_EQ(whyEnded(kExplicit, asking(requestIn(EXS_LittleEndianExplicit, encoding))), "");
        EXPECT_EQ(whyEnded(kImplicit, asking(requestIn(EXS_LittleEndianImplicit, encoding))), "");
        EXPECT_EQ(whyEnded("1.2.840.10008.1.2.2", asking(requestIn(EXS_BigEndianExplicit, encoding))), "");
    }
}

TEST(MessageWatch, LetsSeveralMessagesPassAndWhatIsStoredAsItIs)
{
    const std::string store = fragment(true, command(test::wire::element(0, 0x100, littleEndian(1, 2)))),
                      anything = fragments(false, std::string(kMostMessageBytes + 1, 'x')),
                      asked = asking(element(0x1195, "UI", "1.2."));
    EXPECT_EQ(whyEnded(kExplicit, asked + store + anything + asked), "");
    EXPECT_THAT(whyEnded(kExplicit, store + anything + anything), HasSubstr("a type that is none"))
        << "only the data set of the command itself is stored";
}

TEST(MessageWatch, EndsWhatIsNestedTooDeeply)
{
    EXPECT_EQ(whyEnded(kExplicit, asking(nested(64, true))), "");
    EXPECT_THAT(whyEnded(kExplicit, asking(nested(65, true))), HasSubstr("nested deeper than 64"));
    EXPECT_EQ(whyEnded(kImplicit, asking(nested(64, false))), "");
    EXPECT_THAT(whyEnded(kImplicit, asking(nested(65, false))), HasSubstr("nested deeper than 64"));
    std::string with_lengths = test::wire::element(8, 0x1150, "1.2");
    for (int n = 0; n < 65; ++n)
        with_lengths = test::wire::element(8, 0x1140, test::wire::element(0xfffe, 0xe000, with_lengths));
    EXPECT_THAT(whyEnded(kImplicit, asking(with_lengths)), HasSubstr("nested deeper than 64"));
}

TEST(MessageWatch, EndsWhatHasTooMuchOrNoOrder)
{
    std::string many, backwards;
    for (int n = 0; n < 10'001; ++n)
        many += test::wire::element(0x11, n, "");
    for (int n = 9'999; n > 0; --n)
        backwards += test::wire::element(0x11, n, "");
    EXPECT_THAT(whyEnded(kImplicit, asking(many)), HasSubstr("more than 10000 elements"));
    EXPECT_THAT(whyEnded(kImplicit, asking(backwards)), HasSubstr("not in the order of their tags"));
}

TEST(MessageWatch, EndsValuesThatTheMessageCannotHold)
{
    EXPECT_THAT(whyEnded(kImplicit, asking(tag(8, 0x1195) + littleEndian(0xfffffffe, 4))), HasSubstr("4294967294"));
    EXPECT_THAT(whyEnded(kImplicit, asking(tag(8, 0x1140) + "\xff\xff\xff\xff"s +
                                           test::wire::element(0xfffe, 0xe000, "") + tag(8, 0x1195) + "\4\0\0\0"s)),
                HasSubstr("a sequence holds (0008,1195)"));
    const std::string reaching = tag(8, 0x1150) + "\x20\0\0\0"s + "1.2.";
    EXPECT_THAT(
        whyEnded(kImplicit, asking(test::wire::element(8, 0x1140, test::wire::element(0xfffe, 0xe000, reaching)))),
        HasSubstr("(0008,1150) should have 32 bytes"));
    EXPECT_THAT(whyEnded(kExplicit, asking(tag(8, 0x1195) + "??\4\0"s + "1.2.")), HasSubstr("a type that is none"));
    EXPECT_THAT(whyEnded(kExplicit, asking(tag(8, 0x1195) + "OB\0\0"s + "\xff\xff\xff\xff"s)), HasSubstr("no length"));
}

/// There a library goes on, in what lies within the length for whoever follows it.
TEST(MessageWatch, EndsSequencesThatEndBeforeTheirLengthDoes)
{
    setUpDicom();
    const std::string deep = nested(65, false), end = tag(0xfffe, 0xe0dd) + "\0\0\0\0"s;
    EXPECT_THAT(whyEnded(kImplicit, asking(test::wire::element(8, 0x1140, end + deep))), HasSubstr("ends within"));
    EXPECT_THAT(whyEnded(kImplicit, asking(test::wire::element(8, 0x1140, tag(0xfffe, 0xe000)) + deep)),
                HasSubstr("ends within"));
    EXPECT_EQ(whyEnded(kImplicit, asking(test::wire::element(0x28, 0x120, "\xfe\xff"s))), "") << "a number";
    EXPECT_EQ(whyEnded(kImplicit, asking(test::wire::element(8, 0x1150, "1.2.3456") + tag(8, 0x1155) + "\2\0\0\0"s +
                                         "1."s + test::wire::element(8, 0x1195, "1"))),
              "");
}

TEST(MessageWatch, EndsWhatGrowsWhenItIsReadAndWhatWasNotAgreed)
{
    EXPECT_THAT(whyEnded(kDeflated, asking(std::string(10, 'x'))), HasSubstr("deflated"));
    std::string elsewhere = fragment(false, element(0x1195, "UI", "1.2."));
    elsewhere[10] = 3;  // its context
    EXPECT_THAT(whyEnded(kExplicit, fragment(true, commitmentCommand()) + elsewhere), HasSubstr("not agreed"));
}

TEST(MessageWatch, EndsCommandsThatAreNone)
{
    EXPECT_THAT(whyEnded(kImplicit, fragments(true, command(std::string(8192, '\0')))), HasSubstr("4096 bytes"));
    EXPECT_THAT(whyEnded(kImplicit, fragments(true, command(nested(65, false)))), HasSubstr("nested deeper"));
    EXPECT_THAT(whyEnded(kImplicit, pdu(4, bigEndian(100, 4) + "\1\3"s + "1234")), HasSubstr("does not fit"));
    const std::string both =
        test::wire::element(0, 0x100, littleEndian(0x130, 2)) + test::wire::element(0, 0x100, littleEndian(1, 2));
    EXPECT_THAT(whyEnded(kImplicit, fragment(true, command(both)) + fragments(false, nested(65, false))),
                HasSubstr("nested deeper"))
        << "a command that says two things does not store";
}

}  // namespace
}  // namespace vicon::ingest
