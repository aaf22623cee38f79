"""The claims, one module for a part of the paper; each function decides one."""
