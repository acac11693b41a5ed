"""The Katana 6M180: its wire protocol, its driver and an emulator of it."""
