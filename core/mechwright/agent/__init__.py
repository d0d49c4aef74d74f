"""The commands as tools of the Model Context Protocol, for a program that works on behalf of somebody."""
