# Each row of a page that names a kernel and shows cycles with their band, `N (A-B)`, `N (A to B)`, or a cell `A to B`, is found in what was
# measured: a line of the same kernel with this band and, rounded, these cycles. So is each cell of a kernel with its length, beside a cell
# of cycles, as the front's table has them. Arguments: the pages, --, files of printed tables.
use strict;
use warnings;

sub digits { my $text = shift; 1 while $text =~ s/(\d) (?=\d{3}\b)/$1/; return $text; }

my $name = qr/[a-z0-9]+_[a-z0-9]+_[fq]\d+(?:[ac]\d+)?/;
my (@pages, %measured, %costs);
push @pages, shift while @ARGV && $ARGV[0] ne '--';
shift;
while (<>) {
    my $kernel;
    next unless ($kernel) = /\b($name)\b/;
    while (/([\d.]+)[* ]+\(?(\d+)(?:-| to )(\d+)\b/g) { push @{ $measured{"$kernel $2 $3"} }, $1; }
    while (/\b($name) +(\d+\+\d+|\d+|full) +(\d+)\b/g) { $costs{"$1 $2 $3"} = 1; }
}
@ARGV = @pages;
my ($rows, $wrong, $kernel, $band) = (0, 0);
while (<>) {
    ($kernel, $band) = (undef, undef), next unless /^\|/;
    $band //= /\| band \|/;  # of the table's first line
    $kernel = $1 if /`($name)`/;
    next unless $kernel;
    my $line = digits($_);
    while ($line =~ /`($name)` (\d+\+\d+|\d+|full) \| (\d+) \|/g) {
        $rows++;
        next if $costs{"$1 $2 $3"};
        $wrong++;
        print "$ARGV: $1 of $2 taps: $3 cycles were not measured\n";
    }
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
print "$rows rows of pages, $wrong not as measured\n";
exit($wrong || !$rows ? 1 : 0);
