namespace vicon { int viewer_model_placeholder() { return 0; } }
