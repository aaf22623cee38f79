"""What a certificate is: written, named, and put in words for people."""

NONE = "none"  # for what does not exist
