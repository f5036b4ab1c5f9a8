"""What every report is made of: figures, pictures, a page that fetches nothing, files that are whole or not there."""
