namespace vicon { int viewer_scene_placeholder() { return 0; } }
