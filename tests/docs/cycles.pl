# Each row of a page that names a kernel and shows cycles with their band, `N (A-B)`, `N (A to B)`, or a cell `A to B`, is found in what was
# measured: a line of the same kernel with this band and, rounded, these cycles. Arguments: the pages, --, files of printed tables.
use strict;
use warnings;

sub digits { my $text = shift; 1 while $text =~ s/(\d) (?=\d{3}\b)/$1/; return $text; }

my (@pages, %measured);
push @pages, shift while @ARGV && $ARGV[0] ne '--';
shift;
while (<>) {
    my $kernel;
    next unless ($kernel) = /\b([a-z0-9]+_[a-z0-9]+_[fq]\d+(?:c\d+)?)\b/;
    while (/([\d.]+)[* ]+\(?(\d+)(?:-| to )(\d+)\b/g) { push @{ $measured{"$kernel $2 $3"} }, $1; }
}
@ARGV = @pages;
my ($rows, $wrong, $kernel, $band) = (0, 0);
while (<>) {
    ($kernel, $band) = (undef, undef), next unless /^\|/;
    $band //= /\| band \|/;  # of the table's first line
    $kernel = $1 if /`([a-z0-9]+_[a-z0-9]+_[fq]\d+(?:c\d+)?)`/;
    next unless $kernel;
    my $line = digits($_);
    while ($line =~ /(?:([\d.]+) \((\d+)(?:-| to )(\d+)\)|\| (\d+) to (\d+) \|)/g) {
        next unless defined $1 || $band;
        my ($cycles, $low, $high) = defined $1 ? ($1, $2, $3) : (undef, $4, $5);
        $rows++;
        my $found = $measured{"$kernel $low $high"};
        next if $found && (!defined $cycles || grep { abs($_ - $cycles) <= 0.5 } @$found);
        $wrong++;
        my @near = map { my ($k, $a, $b) = split ' '; $k eq $kernel ? "@{$measured{$_}}[0] ($a to $b)" : () } sort keys %measured;
        print "$ARGV: $kernel: ", ($cycles // 'a band'), " ($low to $high) was not measured; of this kernel: ", join(', ', @near), "\n";
    }
} continue { close ARGV if eof }
print "$rows bands of pages, $wrong not as measured\n";
exit($wrong || !$rows ? 1 : 0);
