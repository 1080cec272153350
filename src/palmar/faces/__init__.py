"""What people and programs see: command line, pictures, pages, files. No mechanics."""
