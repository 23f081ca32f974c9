#pragma once

#include <QWidget>
#include <memory>

#include "session/drawing_thread.h"
#include "vicon/viewer/scene/film.h"

class QProgressBar;
class QPushButton;

namespace vicon::viewer {

/// Films a flight along the path, picture by picture between those of the window; shows how far it is.
class FilmMaker : public QWidget {
    Q_OBJECT
public:
    static constexpr int kPictures_per_s = 25;

    explicit FilmMaker(DrawingThread& drawing, QWidget* parent = nullptr);

    /// A flight from a station to the end of the path. Stops what is being filmed.
    /// @param request how it shall look; its snapshot has the film's size
    /// @param step_mm from picture to picture
    void start(std::shared_ptr<OpenScan> scan, const EndoscopicRequest& request, double from_mm, Heading heading,
               double step_mm, const std::filesystem::path& file);
    void cancel();
    bool running() const { return film_ != nullptr; }

signals:
    void finished(const QString& file);
    void cancelled();
    void failed(const QString& message);  ///< it has ended, and nothing is kept of it

private:
    void next();
    void end();

    DrawingThread& drawing_;
    std::shared_ptr<Film> film_;
    std::shared_ptr<OpenScan> scan_;
    EndoscopicRequest request_;
    QString file_;
    Heading heading_ = Heading::caecum;
    double station_mm_ = 0, from_mm_ = 0, step_mm_ = 1;
    QProgressBar* bar_;
    QPushButton* cancel_;
};

}  // namespace vicon::viewer
