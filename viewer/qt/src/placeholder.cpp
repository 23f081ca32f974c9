namespace vicon {
int viewer_qt_placeholder()
{
    return 0;
}
}  // namespace vicon
