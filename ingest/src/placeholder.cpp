namespace vicon { int ingest_placeholder() { return 0; } }
