#include "film_reader.h"

#include <theora/theoradec.h>

#include <cstring>
#include <stdexcept>

#include "vicon/core/file.h"

namespace vicon::viewer::test {
namespace {

class Player {
public:
    Player()
    {
        th_info_init(&info_);
        th_comment_init(&comment_);
    }
    ~Player()
    {
        th_decode_free(decoder_);
        th_setup_free(setup_);
        th_comment_clear(&comment_);
        th_info_clear(&info_);
    }
    Player(const Player&) = delete;
    Player& operator=(const Player&) = delete;

    void take(ogg_packet& packet, PlayedFilm& film)
    {
        if (!decoder_) {
            const int left = th_decode_headerin(&info_, &comment_, &setup_, &packet);
            if (left < 0)
                throw std::runtime_error("not a film's header");
            if (left > 0)
                return;
            decoder_ = th_decode_alloc(&info_, setup_);
            film.pictures_per_s = double(info_.fps_numerator) / info_.fps_denominator;
        }
        const int done = th_decode_packetin(decoder_, &packet, nullptr);
        if (done != 0 && done != TH_DUPFRAME)
            throw std::runtime_error("a picture cannot be decoded");
        th_ycbcr_buffer planes;
        th_decode_ycbcr_out(decoder_, planes);
        film.pictures.push_back(brightnessOf(planes[0]));
    }

private:
    QImage brightnessOf(const th_img_plane& plane) const
    {
        QImage image(int(info_.pic_width), int(info_.pic_height), QImage::Format_Grayscale8);
        for (int y = 0; y < image.height(); ++y)
            std::memcpy(image.scanLine(y),
                        plane.data + std::ptrdiff_t(y + int(info_.pic_y)) * plane.stride + info_.pic_x,
                        std::size_t(image.width()));
        return image;
    }

    th_info info_{};
    th_comment comment_{};
    th_setup_info* setup_ = nullptr;
    th_dec_ctx* decoder_ = nullptr;
};

}  // namespace

PlayedFilm playFilm(const std::filesystem::path& file)
{
    const std::string bytes = readFile(file);
    ogg_sync_state sync;
    ogg_sync_init(&sync);
    std::memcpy(ogg_sync_buffer(&sync, long(bytes.size())), bytes.data(), bytes.size());
    ogg_sync_wrote(&sync, long(bytes.size()));
    ogg_stream_state stream{};
    bool begun = false;
    Player player;
    PlayedFilm film;
    ogg_page page;
    ogg_packet packet;
    while (ogg_sync_pageout(&sync, &page) == 1) {
        if (!begun)
            ogg_stream_init(&stream, ogg_page_serialno(&page));
        begun = true;
        ogg_stream_pagein(&stream, &page);
        while (ogg_stream_packetout(&stream, &packet) == 1)
            player.take(packet, film);
    }
    if (begun)
        ogg_stream_clear(&stream);
    ogg_sync_clear(&sync);
    return film;
}

}  // namespace vicon::viewer::test
