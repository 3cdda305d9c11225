#!/bin/sh
# plant.pl on a small source: what it must change, and what it must refuse. Argument: the project's folder.
set -u
source=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failures=0
cat >"$folder/code.cpp" <<'CODE'
#include "code.hpp"
#define TWICE(x) ((x) - 7)
namespace rooms {
namespace {

constexpr double share = 0.5;
const Field fields[] = {{"left", 1}, {"right", 2}};

template <class T>
    requires std::integral<T>
T halves(T a, T b) { return (a - b) / 2; }  // a - b, not b - a
}  // namespace

struct Wheel : Base<int> {
    explicit Wheel(double radius) : Base<int>{1}, radius_(radius), turns_{radius > 0.0 ? 1 : 2} { check(radius); }
    ~Wheel() { stop(radius_); }
    bool operator==(const Wheel& other) const { return radius_ == other.radius_; }
    double turn(int steps) const;
    double radius_ = 1.0;
    int turns_{0};
};

double Wheel::turn(int steps) const {
    const char* text = "a - } b";  // a - }
    const auto way = [&](double x) { return x - radius_; };
    for (int i = 0; i < steps; ++i) {
        lost_ = way(i) + static_cast<double>(i /* the - step */ - 1);
        send('}', R"(x - ")");
    }
    return text[0] - way(steps - 1) - 1'000;
}

double area(double a) { return a * a; }
double area(double a, double b) { return a * b; }
auto both(int n) -> std::pair<int, int> { return {n >> 1, n}; }

template <class History, class Format>
int Sum<History, Format>::step(int x) { return x + 1; }
template <class Format>
int Sum<Modes, Format>::step(int x) { return x + 1; }
}  // namespace rooms
CODE

# changed SYMBOL CHANGE OLD NEW: as if the first OLD in the text were NEW.
changed() {
    cp "$folder/code.cpp" "$folder/now.cpp"
    OLD=$3 NEW=$4 perl -0pe 's/\Q$ENV{OLD}\E/$ENV{NEW}/' "$folder/code.cpp" >"$folder/expected.cpp"
    if ! perl "$source/tests/planted/plant.pl" "$folder/now.cpp" "$1" "$2" || ! diff "$folder/expected.cpp" "$folder/now.cpp" ||
        cmp -s "$folder/code.cpp" "$folder/now.cpp"; then
        echo "$1 | $2: expected $4 where $3 was"
        failures=$((failures + 1))
    fi
}
# refused SYMBOL CHANGE TEXT
refused() {
    cp "$folder/code.cpp" "$folder/now.cpp"
    if perl "$source/tests/planted/plant.pl" "$folder/now.cpp" "$1" "$2" >"$folder/said" 2>&1 || ! grep -qF -e "$3" "$folder/said" ||
        ! cmp -s "$folder/code.cpp" "$folder/now.cpp"; then
        echo "$1 | $2: expected \"$3\" and no change, found:"
        cat "$folder/said"
        failures=$((failures + 1))
    fi
}

# What symbols are: with and without their namespaces, classes, and their templates' arguments.
changed share '0.5 => 2' 'share = 0.5' 'share = 2'
changed fields '"left" => "right"' '"left"' '"right"'
changed fields '{"left", ...}, =>' '{"left", 1},' ''
changed halves '- => +' 'return (a - b)' 'return (a + b)'
changed rooms::halves '(...) / 2 => a' '(a - b) / 2' 'a'
changed Wheel::Wheel '> 0.0 => >= 0.0' '> 0.0' '>= 0.0'
changed Wheel::Wheel 'check(...); =>' 'check(radius);' ''
changed Wheel::~Wheel 'radius_ => 0' 'stop(radius_)' 'stop(0)'
changed Wheel::operator== '== other. => != other.' 'radius_ == other' 'radius_ != other'
changed Wheel::radius_ '1.0 => 2.0' 'radius_ = 1.0' 'radius_ = 2.0'
changed Wheel::turns_ '0 => 1' 'turns_{0}' 'turns_{1}'
changed both '>> 1 => >> 2' 'n >> 1' 'n >> 2'
changed 'Sum<Modes>::step' '+ => -' 'int Sum<Modes, Format>::step(int x) { return x +' 'int Sum<Modes, Format>::step(int x) { return x -'
changed 'Sum<History>::step' '+ => -' 'x + 1' 'x - 1'
# Comments, texts and directives hold no tokens; in a change spaces and ends of lines do not count.
changed Wheel::turn 'i-1 => i + 1' 'i /* the - step */ - 1' 'i + 1'
changed Wheel::turn 'lost_ = ...; =>' 'lost_ = way(i) + static_cast<double>(i /* the - step */ - 1);' ''
changed Wheel::turn "1'000 => 1" "1'000" 1
changed Wheel::turn "'}' => '{'" "'}'" "'{'"
# Places that are counted, and overloads, which are one.
changed Wheel::turn '2 of 5: - => +' '- step */ - 1' '- step */ + 1'
changed area 'a * a => a' 'a * a' 'a'
changed area '2 of 2: * => /' 'a * b' 'a / b'
changed both '{n => {m ;; , n => , m' '{n >> 1, n}' '{m >> 1, m}'
# By its line and column, where no symbol is named.
changed 6:26 '0.5 => 0.6' '0.5' '0.6'

refused gone '- => +' 'no gone is in it'
refused eel::turn '- => +' 'no eel::turn is in it'
refused Wheel::turn '% => /' 'expected % once in Wheel::turn, found it 0 times'
refused Wheel::turn '- => +' 'expected - once in Wheel::turn, found it 5 times'
refused Wheel::turn '1 of 4: - => +' 'expected - 4 times in Wheel::turn, found it 5 times'
refused Wheel::turn '6 of 5: - => +' 'expected a place from 1 to 5, found 6'
refused Wheel::turn 'way ... 1000 => way' 'found it 0 times'
refused Wheel::turn 'for ... send => for' 'found it 0 times'
refused Wheel::turn '- 1' 'expected OLD => NEW'
refused Wheel::turn '... 1 => 2' 'expected tokens before =>'
refused 6:25 '0.5 => 0.6' 'at 6:25 is no 0.5'
sed 's/^double area(double a) {/double area(double a) {{/' "$folder/code.cpp" >"$folder/more.cpp" && mv "$folder/more.cpp" "$folder/code.cpp"
refused share '0.5 => 2' 'its brackets do not match'

# A list: each that is stale is named.
cat >"$folder/list" <<'LIST'
# of one file
good | kept.cpp | f | - => +
good | kept.cpp | f | - => +
stale | kept.cpp | f | * => +
same | kept.cpp | f | - => -
lost | lost.cpp | f | - => +
short | kept.cpp | - => +
LIST
echo 'int f(int a) { return a - 1; }' >"$folder/kept.cpp"
perl "$source/tests/planted/plant.pl" --check "$folder" <"$folder/list" >"$folder/said" 2>&1 && failures=$((failures + 1))
cat >"$folder/expected" <<'SAID'
good: kept.cpp: it is there twice
stale: kept.cpp: expected * once in f, found it 0 times
same: kept.cpp: it changes nothing
lost: lost.cpp: it cannot be read
short: kept.cpp: expected NAME | FILE | SYMBOL | CHANGE, found short | kept.cpp | - => +
SAID
diff "$folder/expected" "$folder/said" || failures=$((failures + 1))
[ "$failures" -eq 0 ]
